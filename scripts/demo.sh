#!/usr/bin/env bash
# Shows what difmesh does, on a fresh Debian 12 machine too: installs what is missing, builds the
# program, reconstructs two merged drops from a flow solver in two ways, and compares the surfaces.
# Run it as often as you like and from anywhere; it writes to build/demo and demo-out in the
# project's folder.
set -euo pipefail
export LC_ALL=C
cd "$(dirname "$(realpath "$0")")/.."

field=examples/data/gerris_drops64_t0.45.nrrd
out=demo-out
placements=(linear plic)

scripts/setup.sh
echo "demo: building in build/demo"
mkdir -p build/demo "$out"
if ! {
  cmake --preset release -B build/demo -DDIFMESH_WITH_IO=ON -DDIFMESH_WITH_CLI=ON \
    -DDIFMESH_WITH_TESTS=OFF -DDIFMESH_WITH_CGAL_TESTS=OFF
  cmake --build build/demo --target difmesh -j "$(nproc)"
} >build/demo/demo.log 2>&1; then
  tail -n 40 build/demo/demo.log >&2
  echo "demo: the build failed; all it said is in build/demo/demo.log" >&2
  exit 1
fi
difmesh=build/demo/cli/difmesh

for placement in "${placements[@]}"; do
  "$difmesh" reconstruct "$field" -o "$out/drops_$placement.ply" --placement "$placement" \
    --report "$out/drops_$placement.json" --quiet
  "$difmesh" info "$out/drops_$placement.ply" --json "$out/drops_$placement.info.json"
done

"$difmesh" reconstruct "$field" -o "$out/drops_plic.glb" --color-by angle --quiet
"$difmesh" reconstruct "$field" -o "$out/drops_plic_draco.glb" --color-by angle --draco --quiet
page="$out/drops.html"
if "$difmesh" view --help >/dev/null 2>&1; then
  "$difmesh" view "$field" -o "$page" --color-by angle --quiet
else
  rm -f "$page"
  echo "demo: no page: it needs node and npm when the program is built" >&2
fi

# value FILE SECTION KEY: a number or word of a report, which has one key per line.
value() {
  sed -n "/\"$2\": {/,/}/ s/^ *\"$3\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1"
}

# row NAME FORMAT FILE-SUFFIX SECTION KEY [FACTOR]: one line of the table, a value per placement.
row() {
  printf '  %-34s' "$1"
  for placement in "${placements[@]}"; do
    value "$out/drops_$placement$3" "$4" "$5" |
      awk -v format="$2" -v factor="${6:-}" \
        '{ printf "%14s", sprintf(format, factor == "" ? $1 : $1 * factor) }'
  done
  echo
}

echo
echo "Two drops that merge, from the flow solver Gerris: $field"
"$difmesh" info "$field" | grep -E '^(cells|interfacial)' | sed 's/^/  /'
echo
printf '  %-34s' "placement of vertices"
printf '%14s' "${placements[@]}"
echo
row "vertices" %d .json mesh vertices
row "triangles" %d .json mesh triangles
row "closed" %s .json mesh closed
row "manifold" %s .info.json mesh manifold
row "volume in the field's fractions" %.6g .json field fraction_volume
row "volume inside the mesh" %.6g .json mesh enclosed_volume
row "relative difference" %+.2e .json mesh volume_difference
row "roughness, degrees" %.2f .info.json mesh roughness_degrees
for phase in read classify normals count vertices triangles; do
  row "milliseconds: $phase" %.2f .json seconds "$phase" 1000
done
cat <<END

  Both meshes have the same triangles; what differs is where their vertices are put. Roughness is
  the rms angle between neighbouring facets.

Sizes in bytes:
END
for file in drops_plic.ply drops_plic.glb drops_plic_draco.glb drops.html; do
  [ ! -e "$out/$file" ] || printf '  %-34s%14d\n' "$file" "$(stat -c %s "$out/$file")"
done
cat <<END

Written to $(pwd)/$out:
  drops_linear.ply, drops_plic.ply    the meshes
  drops_plic.glb                      for viewers, colored by the angle between facets
  drops_plic_draco.glb                the same, compressed
  drops.html                          a page with both meshes, for any browser
  drops_*.json, drops_*.info.json     reports: the work, and the meshes measured
Next:
  look at the meshes                  open drops.html; or ParaView, MeshLab, Blender
  see all options                     $difmesh reconstruct --help
  try a field of your own             $difmesh info FIELD.npy
                                      $difmesh reconstruct FIELD.npy -o surface.ply --spacing 0.01
END
