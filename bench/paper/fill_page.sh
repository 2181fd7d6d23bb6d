#!/usr/bin/env bash
# Puts the tables of a run into a page: fill_page.sh PAGE FOLDER
# What is between the lines "<!-- table: NAME -->" and "<!-- end -->" becomes FOLDER/NAME.md.
set -euo pipefail
page=$1
folder=$2

filled=$(mktemp)
trap 'rm -f "$filled"' EXIT
awk -v folder="$folder" '
  /^<!-- end -->$/ { within = 0 }
  !within { print }
  /^<!-- table: .* -->$/ {
    file = folder "/" $3 ".md"
    while ((status = (getline line < file)) > 0) print line
    if (status < 0) { print "no table " file > "/dev/stderr"; exit 1 }
    within = 1
  }' "$page" >"$filled"
cat "$filled" >"$page"
