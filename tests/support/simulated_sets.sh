# For scripts that train on simulated people: set `simulated` (a folder) and `bin`, source this, then call
# simulate NAME SET SENSOR FRAMES SEED [OPTION...] for each set. The folders are listed in `folders`; those that are
# there already stay as they are.
folders=()

# Cameras near the floor, above heads, and such that look up, as robots of other sizes have them, and at a desk, where
# legs are out of sight. Near a robot, where heads may be above the image.
low=(--min-camera-height-m 0.2 --max-camera-height-m 0.6 --pitch-down-deg -12)
high=(--min-camera-height-m 1.8 --max-camera-height-m 2.4 --pitch-down-deg 22)
up=(--pitch-down-deg -20)
desk=(--min-distance-m 0.6 --max-distance-m 1.5 --min-camera-height-m 1 --max-camera-height-m 1.6)
near_rooms=(--min-camera-height-m 0.4 --max-camera-height-m 1.3 --min-distance-m 0.6 --max-distance-m 2.4)

# Scanners: a dense raster, and 32 rings over a usual and a wide angle; people in coats, children among them.
dense=(--rings 269 --azimuth-step-deg 0.25 --max-azimuth-deg 45 --max-elevation-deg 33.5)
few=(--rings 32 --azimuth-step-deg 0.35 --range-sigma-m 0.015)
wide=("${few[@]}" --max-elevation-deg 45)
coats=(--coat-share 0.4 --child-share 0.15)
# 128 rings over 90 degrees and 16 over 30; streets, and a car's scanner that looks down on them.
many=(--rings 128 --max-elevation-deg 45)
sixteen=(--rings 16 --max-elevation-deg 15)
streets=(--street-share 1 --max-camera-height-m 2.1)
car_roof=(--rings 64 --max-elevation-deg 13.4 --pitch-down-deg 11.4 --min-camera-height-m 1.5 "${streets[@]}")

simulate() {
  local folder=$simulated/$1
  folders+=("$folder")
  [ -e "$folder/timestamps.csv" ] && return
  echo "simulating $folder"
  "$bin/limbcast-simulate" --output "$folder" --set "$2" --sensor "$3" --frames "$4" --seed "$5" "${@:6}"
}
