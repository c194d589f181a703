# offered.zsh COMPLETION LINE DUMP: what the completion of zsh offers after a line, a line each. DUMP is a file where it
# keeps what it finds, for the next call.
#
# A shell behind a terminal types the line and the tab. There what adds matches also prints them.
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PROMPT= RPROMPT=; stty -echo; autoload -U compinit; [[ -s ${(q)3} ]] && compinit -C -d ${(q)3} || compinit -u -d ${(q)3}; source ${(q)1}
  bindkey '^I' complete-word; unsetopt list_beep
  compadd() {
    case \${@[1,(i)(-|--)]} in *-(O|A|D)\ *) builtin compadd \"\$@\"; return ;; esac
    local -a found
    local each
    builtin compadd -A found \"\$@\"
    for each in \$found; do print -r -- \"offered:\$each\"; done
    builtin compadd \"\$@\"
  }
  comppostfuncs=(finish); finish() { print -r -- 'offered'-all }
  print -r -- 'is ''ready'"
local said
zpty -r -m shell said '*is ready*' || return 1
zpty -w -n shell "$2"$'\t'
zpty -r -m shell said '*offered-all*'
zpty -d shell
print -r -- ${(F)${(M)${(f)${said//$'\r'/}}:#*offered:*}##*offered:}
