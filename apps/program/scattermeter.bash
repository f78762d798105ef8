# Completion of scattermeter for bash: commands, options and choices as listed by --help.
_scattermeter() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
  local program=${COMP_WORDS[0]} path=() word help words
  # Only words that can be commands are passed on, so that nothing but --help can be started.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word =~ ^[a-z]+$ ]] && path+=("$word")
  done
  help=$("$program" "${path[@]}" --help 2>/dev/null)
  [[ $prev =~ ^-[a-z-]+$ ]] &&
    words=$(sed -nE "s/^  $prev [A-Z]+:\{([^}]*)\}.*/\1/p" <<<"$help")
  if [[ $words ]]; then
    words=${words//,/ }
  elif [[ $cur == -* ]]; then
    # The options of the program itself are accepted by every command.
    words=$(sed -nE 's/^  ((-[a-z]),)?(--[a-z-]+).*/\2 \3/p' \
      <<<"$help"$'\n'"$("$program" --help 2>/dev/null)")
  else
    words=$(sed -nE 's/^  ([a-z]+)( .*)?$/\1/p' <<<"$help")
  fi
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
}
complete -o default -F _scattermeter scattermeter
