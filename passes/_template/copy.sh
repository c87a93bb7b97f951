#!/usr/bin/env bash
# passes/_template/copy.sh NAME: begins a technique of that name (snake_case) as a copy of this folder, and prints what it
# wrote. What is then left to do by hand: docs/new_technique.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

name=${1:-}
if (( $# != 1 )) || [[ ! $name =~ ^[a-z][a-z0-9]*(_[a-z0-9]+)*$ ]]; then
  echo "copy.sh: '$name' is no name for a technique; give one in snake_case, such as two_pass_filter" >&2
  exit 2
fi
camel=$(sed -E 's/(^|_)(.)/\U\2/g' <<<"$name")

# FROM TO: a copy with the new name, and with paths as they are at the new place.
copy() {
  mkdir -p "$(dirname "$2")"
  sed -e "s,\"shared/template_technique.h\",\"shaders/shared/$name.h\"," -e "s,passes/_template/,passes/$name/," \
    -e "s/template_technique/$name/g" -e "s/TemplateTechnique/$camel/g" -e "s/TEMPLATE_TECHNIQUE/${name^^}/g" "$1" >"$2"
  echo "wrote $2"
}

template=passes/_template
files=(
  "$template/README.md passes/$name/README.md"
  "$template/template_technique.h passes/$name/$name.h"
  "$template/template_technique.cpp passes/$name/$name.cpp"
  "$template/shaders/gather.comp shaders/$name/gather.comp"
  "$template/shaders/shared/template_technique.h shaders/shared/$name.h"
  "$template/tests/template_technique_test.cpp tests/gpu/techniques/${name}_test.cpp"
)
for file in "${files[@]}"; do
  if [[ -e ${file#* } ]]; then
    echo "copy.sh: ${file#* } exists already and nothing was written; choose another name" >&2
    exit 2
  fi
done
for file in "${files[@]}"; do
  # shellcheck disable=SC2086  # two words on purpose: from, to
  copy $file
done
