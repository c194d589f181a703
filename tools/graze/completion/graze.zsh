#compdef graze
# Completion of zsh for graze: commands, options, words that an option takes, and files by their endings.
# The lines between "begin" and "end" are of the program's help: tests/packages/program_pages.py PROGRAM --write

# begin commands
_graze_commands() {
  local -a commands=(
    'run:Steps through a scene, prints what touched, where and when, and writes what is asked for.'
    'inspect:Says what mesh or scene files hold\: axes and unit, objects, animations, counts, what is odd, regions, bytes.'
    'replay:Does a recording again and compares every frame with what was recorded.'
    'info:Checks a recording and says what it holds\: frames, objects, contacts, times.'
    'worst:Finds what may be wrong in a recording\: the deepest contacts, the largest jumps, the longest steps.'
    'cut:Writes a part of a recording\: some frames, and two objects if asked. It begins where they are.'
    'view:Writes a page that shows a recording in a browser, frame by frame.'
    'picture:Draws a frame of a recording into a PNG.'
    'export:Writes a recording for other programs\: tables, a time series for ParaView, a frame as glTF.'
  )
  _describe command commands
}

# _graze_arguments [COMMAND]: what a command takes, or the program.
_graze_arguments() {
  case $1 in
    '')
      _arguments -C \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--version)--version[Display program version information and exit]' \
        '1:command:_graze_commands' \
        '*::argument:_graze_after_command'
      ;;
    run)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--frames)--frames[How many frames; else the scene'\''s, else the longest motion]:value: ' \
        '(--threads)--threads[How many threads; 0, the default\: one for each processor. At most 8 for each are used]:value: ' \
        '(--contact-distance)--contact-distance[Strictly closer than this is a contact]:value: ' \
        '(--range)--range[Pairs closer than this are listed with their distance]:value: ' \
        '(--detail)--detail[none, closest, regions, vertices, features or nearest]:value:(none closest regions vertices features nearest)' \
        '(--accuracy)--accuracy[exact, within\:T, paper or paper\:E1,E2,...]:value:(exact within\: paper paper\:)' \
        '(--max-contacts)--max-contacts[List at most so many contacts a frame, the nearest]:value: ' \
        '(--max-contacts-per-pair)--max-contacts-per-pair[List at most so many contacts of each pair, the nearest]:value: ' \
        '(--frames-per-second)--frames-per-second[At which rate animations are sampled]:value: ' \
        '(--report)--report[Write a report, JSON Lines, a line a frame; compressed if the name ends in .gz]:file: _graze_files jsonl jsonl.gz' \
        '(--report-every)--report-every[Write each K-th frame into the report]:value: ' \
        '(--report-pairs)--report-pairs[Leave contacts out of the report\: pairs alone, with their number of contacts]' \
        '(--record)--record[Record the run, for graze replay, view and picture]:file: _graze_files graze' \
        '(--outside-files)--outside-files[Let mesh files name files outside their own folders, such as buffers of glTF]' \
        '(--no-times)--no-times[Leave timings out of the report and the page\: equal runs, equal files]' \
        '(--picture)--picture[Draw one frame into a PNG]:file: _graze_files png' \
        '(--picture-frame)--picture-frame[Which one; else the first with most contacts]:value: ' \
        '(--html)--html[Write a page that plays all frames in a browser, or its data (.grazeview)]:file: _graze_files html grazeview' \
        '(--html-every)--html-every[Write each K-th frame into the page]:value: ' \
        '(--region-distances)--region-distances[List at most so many distances between regions a frame, for the page; 0, the default\: none]:value: ' \
        '(--ways-out)--ways-out[Say how objects leave each other whose surfaces pass through each other]' \
        '(--carrying)--carrying[With nearest, list at most so many contacts of each pair, chosen to carry it; 0\: all]:value: ' \
        '(--carrying-band)--carrying-band[How much less deep than the deepest they may be; else the threshold of the pair]:value: ' \
        '(--sweep-tolerance)--sweep-tolerance[How far apart the bounds of an impact'\''s time are at most, of a step that takes time 1]:value: ' \
        '(--swept-gap)--swept-gap[Say when swept objects come that near on the way; 0\: do not]:value: ' \
        '*:file: _graze_files json obj ply off stl gltf glb fbx dae x 3ds blend 3mf'
      ;;
    inspect)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--outside-files)--outside-files[Let mesh files name files outside their own folders, such as buffers of glTF]' \
        '*:file: _graze_files json obj ply off stl gltf glb fbx dae x 3ds blend 3mf'
      ;;
    replay)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--threads)--threads[How many threads, in place of the recorded number]:value: ' \
        '(--instruction-set)--instruction-set[scalar, baseline, avx2 or avx512, in place of the best one]:value:(scalar baseline avx2 avx512)' \
        '(--from)--from[Compare from this frame on, counted from 0]:value: ' \
        '(--validate)--validate[Check all structures too, if graze is built for it]' \
        '1:file: _graze_files graze'
      ;;
    info)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '1:file: _graze_files graze'
      ;;
    worst)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--frames)--frames[Frames counted from 0, such as 10..20, 10.. or ..20]:value: ' \
        '(--count)--count[How many of each to list; 5 by default]:value: ' \
        '1:file: _graze_files graze'
      ;;
    cut)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--frames)--frames[Frames counted from 0, such as 10..20, 10.. or ..20]:value: ' \
        '(--pair)--pair[Two objects, by name or by number, such as bowl,letter]:value: :value: ' \
        '(-o --output)-o[The file to write]:file: _graze_files graze' \
        '(-o --output)--output[The file to write]:file: _graze_files graze' \
        '1:file: _graze_files graze'
      ;;
    view)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(-o --output)-o[The page to write (.html), or its data (.grazeview), which a page opens]:file: _graze_files html grazeview' \
        '(-o --output)--output[The page to write (.html), or its data (.grazeview), which a page opens]:file: _graze_files html grazeview' \
        '(--every)--every[Write each K-th frame]:value: ' \
        '1:file: _graze_files graze'
      ;;
    picture)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--frame)--frame[Counted from 0; else the first with most contacts]:value: ' \
        '(--lines)--lines[Draw the lines between middle vertices of regions that are near, in a colour for each level]' \
        '(--select)--select[Draw only these objects, by name or by number]:value: ' \
        '(-o --output)-o[The PNG to write]:file: _graze_files png' \
        '(-o --output)--output[The PNG to write]:file: _graze_files png' \
        '1:file: _graze_files graze'
      ;;
    export)
      _arguments \
        '(-h --help)-h[Print this help message and exit]' \
        '(-h --help)--help[Print this help message and exit]' \
        '(--frames)--frames[Frames counted from 0, such as 10..20, 10.. or ..20]:value: ' \
        '(--csv)--csv[Write a table of all contacts as CSV]:file: _graze_files csv' \
        '(--distances)--distances[Write a table of the rows of all reports as CSV]:file: _graze_files csv' \
        '(--paraview)--paraview[Write a time series\: this .pvd, and .vtp files in a folder beside it]:file: _graze_files pvd' \
        '(--gltf)--gltf[Write a frame as glTF 2, into a .gltf or a .glb]:file: _graze_files gltf glb' \
        '(--frame)--frame[Which frame; else the first with most contacts]:value: ' \
        '1:file: _graze_files graze'
      ;;
  esac
}
# end commands

# _graze_files ENDING...: folders, and files that end so.
_graze_files() { _files -g "*.(${(j:|:)@})(-.)" }

_graze_after_command() { _graze_arguments "${words[1]}" }

_graze() { _graze_arguments '' }

# The file is read as a function where completion is started, and by "source" in a shell that has it already.
if [[ $zsh_eval_context[-1] = loadautofunc ]]; then
  _graze "$@"
else
  compdef _graze graze
fi
