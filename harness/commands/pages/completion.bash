# The words above as completions. `words` is the line up to the cursor, split at blanks alone, for bash
# also splits at "=" and ":"; `value` is what is completed of the last word, and `before` what stands
# before it in that word.

# Adds the words of $1 that begin as $value does, with $before before each and $2 behind.
_raingauge_add()
{
    local found
    mapfile -t found < <(compgen -P "$before" -S "${2-}" -W "$1" -- "$value")
    COMPREPLY+=("${found[@]}")
}

# Adds the paths that compgen's action $1 finds.
_raingauge_add_paths()
{
    local found
    mapfile -t found < <(compgen -P "$before" -A "$1" -- "$value")
    COMPREPLY+=("${found[@]}")
    compopt -o filenames 2> /dev/null
}

# The devices of this machine, which the program is asked for once.
_raingauge_ask_devices()
{
    [[ ${_raingauge_words[@device]+set} ]] && return
    _raingauge_words[@device]=$("${words[0]}" list devices 2> /dev/null | cut -d ' ' -f 1)
}

# Adds the techniques' parameters; after KEY= the values of that.
_raingauge_add_parameters()
{
    local technique key= named=
    for technique in ${_raingauge_words[@techniques]}; do
        [[ " ${words[*]:2} " == *" $technique "* ]] && named+="$technique "
    done
    [[ $value == *=* ]] && key=${value%%=*} before+=$key= value=${value#*=}
    for technique in ${named:-${_raingauge_words[@techniques]}}; do
        if [[ $key ]]; then
            _raingauge_expand "${_raingauge_words["$technique $key"]-}"
        else
            _raingauge_add "${_raingauge_words["$technique parameters"]}" =
            compopt -o nospace 2> /dev/null
        fi
    done
}

# Adds what the words and lists of $1 stand for.
_raingauge_expand()
{
    local list
    for list in $1; do
        case $list in
        @files) _raingauge_add_paths file ;;
        @folders) _raingauge_add_paths directory ;;
        @parameters) _raingauge_add_parameters ;;
        @device)
            _raingauge_ask_devices
            _raingauge_add "${_raingauge_words[@device]}"
            ;;
        @devices)
            _raingauge_ask_devices
            [[ $value == *,* ]] && before+=${value%,*}, value=${value##*,} || _raingauge_add all
            _raingauge_add "${_raingauge_words[@device]}"
            ;;
        @*) _raingauge_add "${_raingauge_words[$list]}" ;;
        *) _raingauge_add "$list" ;;
        esac
    done
}

# Completes what stands behind a command.
_raingauge_complete_command()
{
    local command=${words[1]} option= place=1 word
    for word in "${words[@]:2:${#words[@]}-3}"; do
        if [[ $option ]]; then
            option=
        elif [[ ${_raingauge_words["$command $word"]+set} && $word == -* ]]; then
            option=$word
        elif [[ $word != -* ]]; then
            ((place++))
        fi
    done
    if [[ $option ]]; then
        _raingauge_expand "${_raingauge_words["$command $option"]}"
    elif [[ $value == --*=* ]]; then
        option=${value%%=*} before=${value%%=*}= value=${value#*=}
        _raingauge_expand "${_raingauge_words["$command $option"]-}"
    elif [[ $value == -* ]]; then
        _raingauge_add "${_raingauge_words["$command options"]-}"
    else
        _raingauge_expand "${_raingauge_words["$command $place"]-${_raingauge_words["$command +"]-}}"
    fi
}

_raingauge()
{
    local line=${COMP_LINE:0:COMP_POINT} before= value words
    read -ra words <<< "$line"
    [[ $line == *[[:blank:]] ]] && words+=("")
    value=${words[-1]}
    COMPREPLY=()
    if ((${#words[@]} == 2)); then
        _raingauge_add "${_raingauge_words[commands]} --help --version"
    else
        _raingauge_complete_command
    fi
    # Bash replaces what it takes for the last word: what stands behind the last of its word breaks.
    local last=${words[-1]} breaks=${COMP_WORDBREAKS//[!=:]/}
    [[ $breaks ]] && COMPREPLY=("${COMPREPLY[@]#"${last%"${last##*["$breaks"]}"}"}")
}

complete -F _raingauge raingauge
