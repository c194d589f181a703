# Completion of bash for graze: commands, options, words that an option takes, and files by their endings.
# The lines between "begin" and "end" are of the program's help: tests/packages/program_pages.py PROGRAM --write

# begin commands
_graze_commands() { echo 'run inspect replay info worst cut view picture export'; }

# _graze_options COMMAND: the options of a command, or of the program.
_graze_options() {
  case $1 in
    '') echo '-h --help --version' ;;
    run) echo '-h --help --frames --threads --contact-distance --range --detail --accuracy --max-contacts --max-contacts-per-pair --frames-per-second --report --report-every --report-pairs --record --outside-files --no-times --picture --picture-frame --html --html-every --region-distances --ways-out --carrying --carrying-band --sweep-tolerance --swept-gap' ;;
    inspect) echo '-h --help --outside-files' ;;
    replay) echo '-h --help --threads --instruction-set --from --validate' ;;
    info) echo '-h --help' ;;
    worst) echo '-h --help --frames --count' ;;
    cut) echo '-h --help --frames --pair -o --output' ;;
    view) echo '-h --help -o --output --every' ;;
    picture) echo '-h --help --frame --lines --select -o --output' ;;
    export) echo '-h --help --frames --csv --distances --paraview --gltf --frame' ;;
  esac
}

# _graze_value 'COMMAND OPTION': what may follow. 'words:' alone stands for what only the user knows.
_graze_value() {
  case $1 in
    'run --frames') echo 'words:' ;;
    'run --threads') echo 'words:' ;;
    'run --contact-distance') echo 'words:' ;;
    'run --range') echo 'words:' ;;
    'run --detail') echo 'words: none closest regions vertices features nearest' ;;
    'run --accuracy') echo 'words: exact within: paper paper:' ;;
    'run --max-contacts') echo 'words:' ;;
    'run --max-contacts-per-pair') echo 'words:' ;;
    'run --frames-per-second') echo 'words:' ;;
    'run --report') echo 'files: jsonl jsonl.gz' ;;
    'run --report-every') echo 'words:' ;;
    'run --record') echo 'files: graze' ;;
    'run --picture') echo 'files: png' ;;
    'run --picture-frame') echo 'words:' ;;
    'run --html') echo 'files: html grazeview' ;;
    'run --html-every') echo 'words:' ;;
    'run --region-distances') echo 'words:' ;;
    'run --carrying') echo 'words:' ;;
    'run --carrying-band') echo 'words:' ;;
    'run --sweep-tolerance') echo 'words:' ;;
    'run --swept-gap') echo 'words:' ;;
    run) echo 'files: json obj ply off stl gltf glb fbx dae x 3ds blend 3mf' ;;
    inspect) echo 'files: json obj ply off stl gltf glb fbx dae x 3ds blend 3mf' ;;
    'replay --threads') echo 'words:' ;;
    'replay --instruction-set') echo 'words: scalar baseline avx2 avx512' ;;
    'replay --from') echo 'words:' ;;
    replay) echo 'files: graze' ;;
    info) echo 'files: graze' ;;
    'worst --frames') echo 'words:' ;;
    'worst --count') echo 'words:' ;;
    worst) echo 'files: graze' ;;
    'cut --frames') echo 'words:' ;;
    'cut --pair') echo 'words:' ;;
    'cut -o' | 'cut --output') echo 'files: graze' ;;
    cut) echo 'files: graze' ;;
    'view -o' | 'view --output') echo 'files: html grazeview' ;;
    'view --every') echo 'words:' ;;
    view) echo 'files: graze' ;;
    'picture --frame') echo 'words:' ;;
    'picture --select') echo 'words:' ;;
    'picture -o' | 'picture --output') echo 'files: png' ;;
    picture) echo 'files: graze' ;;
    'export --frames') echo 'words:' ;;
    'export --csv') echo 'files: csv' ;;
    'export --distances') echo 'files: csv' ;;
    'export --paraview') echo 'files: pvd' ;;
    'export --gltf') echo 'files: gltf glb' ;;
    'export --frame') echo 'words:' ;;
    export) echo 'files: graze' ;;
  esac
}
# end commands

# _graze_files ENDING...: folders, and files that end so. Without endings all files.
_graze_files() {
  local word ending
  compopt -o filenames 2>/dev/null
  COMPREPLY=()
  while IFS= read -r word; do COMPREPLY+=("$word"); done < <(
    compgen -d -- "$current"
    [ $# -gt 0 ] || compgen -f -- "$current"
    for ending in "$@"; do compgen -f -X "!*.$ending" -- "$current"; done | sort -u
  )
}

# _graze_words WORD...: those words that go on with what is typed.
_graze_words() {
  local word
  COMPREPLY=()
  for word in "$@"; do
    case $word in "$current"*) COMPREPLY+=("$word") ;; esac
  done
}

_graze() {
  local current=${COMP_WORDS[COMP_CWORD]} before='' command='' kind
  [ "$COMP_CWORD" -lt 1 ] || before=${COMP_WORDS[COMP_CWORD - 1]}
  [ "$COMP_CWORD" -lt 2 ] || command=${COMP_WORDS[1]}
  if [ -z "$command" ]; then
    # shellcheck disable=SC2046 # a list of words
    _graze_words $(_graze_options '') $(_graze_commands)
    return
  fi
  kind=$(_graze_value "$command $before")
  case $current in -*) [ -n "$kind" ] || kind="words: $(_graze_options "$command")" ;; esac
  [ -n "$kind" ] || kind=$(_graze_value "$command")
  # shellcheck disable=SC2086 # a list of words
  case $kind in
    words:*) _graze_words ${kind#words:} ;;
    files:*) _graze_files ${kind#files:} ;;
    *) COMPREPLY=() ;;
  esac
}

complete -F _graze graze
