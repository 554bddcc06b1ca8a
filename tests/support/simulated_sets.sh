# For scripts that train on simulated people: set `simulated` (a folder) and `bin`, source this, then call
# simulate NAME SET SENSOR FRAMES SEED [OPTION...] for each set. The folders are listed in `folders`; those that are
# there already stay as they are.
folders=()

simulate() {
  local folder=$simulated/$1
  folders+=("$folder")
  [ -e "$folder/timestamps.csv" ] && return
  echo "simulating $folder"
  "$bin/limbcast-simulate" --output "$folder" --set "$2" --sensor "$3" --frames "$4" --seed "$5" "${@:6}"
}
