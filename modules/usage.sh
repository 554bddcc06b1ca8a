# For the scripts that users start, which source it before they change the folder.

wrong_usage() {  # wrong_usage WHAT
  echo "$(basename "$0" .sh): $1; see $0 --help" >&2
  exit 2
}

# The comment that a script begins with is its help.
help_if_asked() {  # help_if_asked "$@"
  case ${1:-} in -h | --help) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
}

check_arguments() {  # check_arguments LEAST MOST "$@"
  help_if_asked "${@:3}"
  case ${3:-} in -*) wrong_usage "$3: there is no such option" ;; esac
  [ $# -ge $(($1 + 2)) ] || wrong_usage "$(($# - 2)) arguments are too few"
  [ $# -le $(($2 + 2)) ] || wrong_usage "${*:$(($2 + 3)):1}: one argument too many"
}
