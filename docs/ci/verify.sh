#!/bin/sh
# Verifies every scene of a repository: for any service that runs a shell, or at home before a commit.
#   verify.sh [FOLDER OF SCENES] [FOLDER OF DATA]       default: scenes data
# Results: verify.xml for services that show tests, verify.html to look at, pictures/ to compare a later run with ($AGAINST).
set -u
scenes=${1:-scenes}
data=${2:-data}
for scene in "$scenes"/*.toml; do
  [ -e "${scene%.toml}.lock" ] || echo "$scene has no lock: belvedere lock $scene --data $data" >&2
done
exec "${BELVEDERE:-belvedere}" verify "$scenes"/*.toml --data "$data" --quiet \
  --out pictures --junit verify.xml --report verify.html ${AGAINST:+--against "$AGAINST"}
