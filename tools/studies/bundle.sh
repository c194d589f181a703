#!/bin/sh
# Packs graze_studies with the libraries that it needs into one archive, to measure threads on another machine with the
# same kind of processor. The archive needs nothing there but a shell and tar:
#
#   tools/studies/bundle.sh build/release/tools/studies scaling.tar.gz
#   tar xzf scaling.tar.gz && graze_scaling/measure.sh 1,2,4,8,16
#
# The second command takes under five minutes, and writes tables and JSON into the folder graze_scaling.
set -eu
[ "$#" -eq 2 ] || {
  echo "usage: bundle.sh FOLDER_OF_GRAZE_STUDIES ARCHIVE.tar.gz" >&2
  exit 2
}
programs=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/graze_scaling"
cp "$programs/graze_studies" "$programs/graze_bench_peers.so" "$folder/graze_scaling"

# The loader goes along, since that of the other machine may be older than the C library here.
ldd "$programs/graze_studies" "$programs/graze_bench_peers.so" | sed -n 's/.*=> \(\/[^ ]*\).*/\1/p; s/^\t\(\/[^ ]*ld-[^ ]*\).*/\1/p' |
  sort -u | while read -r library; do cp -L "$library" "$folder/graze_scaling"; done

cat >"$folder/graze_scaling/measure.sh" <<'END'
#!/bin/sh
# Measures how steps scale with each of these numbers of threads: measure.sh 1,2,4,8,16
set -eu
cd "$(dirname "$0")"
threads=${1:-1,2,4,8,16}
loader=$(echo ./ld-*)
"$loader" --library-path . ./graze_studies bench --scaling --frames 30 --threads "$threads" \
  --scenes S1,S2,S3,S4,S6a,S6c,G1000,G10000 --csv scaling.csv --json scaling.json | tee scaling.md
END
chmod +x "$folder/graze_scaling/measure.sh"
tar -C "$folder" -czf "$2" graze_scaling
