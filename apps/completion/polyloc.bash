# Completion for bash of the programs of mrpt_polyloc: options as the program's own --help lists
# them, names where an option takes one of a few, else files.

_polyloc() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local words=
  COMPREPLY=()
  # What stands behind an option that takes a value: --help names it in capitals.
  case "$before" in
    --method) words='certified cells exact' ;;
    --search-metric) words='robust polar' ;;
    --nearest) words='index tree' ;;
    --init) words='polyloc uniform tracker' ;;
    --strategy) words='greedy nearest majority random' ;;
  esac
  if [ -z "$words" ] && [[ $word == -* ]]; then
    words=$("$program" --help 2> /dev/null | sed -n 's/^  \(-[^ ]*\).*/\1/p' | tr ',' ' ')
  fi
  if [ -n "$words" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    return
  fi
  compopt -o filenames 2> /dev/null || true
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}

complete -F _polyloc polyloc-calibrate polyloc-dataset polyloc-eval polyloc-localize polyloc-map \
  polyloc-replay polyloc-simulate polyloc-travel polyloc-view
