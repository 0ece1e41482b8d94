#!/bin/bash
# run.sh PROGRAM FILE.prm
# The first line of FILE is "# EXPECT: regex"; a line "# OPTIONS: ..." after it adds options. The program must leave
# with exit code 1, say one sentence that matches, and leave no files behind; with --check as well, unless a line
# "# NOT BY CHECK: reason" says why that cannot know.
program=$1
file=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
expect=$(sed -n '1s/^# EXPECT: //p' "$file")
options=$(sed -n '2,3s/^# OPTIONS: //p' "$file")
[ -n "$expect" ] || { echo "$file: the first line is not '# EXPECT: regex'"; exit 1; }
cd "$folder" || exit 1
fail() { echo "FAILED: $1"; echo "expected: $expect"; echo "message:  ${message:-$(cat message)}"; exit 1; }
refused() { # options
  unset message
  eval "\"$program\" \"$file\" $1" >screen 2>message
  code=$?
  [ $code = 1 ] || fail "exit code $code instead of 1 with options $1"
  [ "$(wc -l <message)" = 1 ] || fail "the message is not one line"
  [ "$(wc -c <message)" -le 700 ] || fail "the message has $(wc -c <message) characters, more than 700"
  grep -qE -- "$expect" message || fail "the message does not match"
  cat message
  message=$(cat message)
  banner=$(wc -c <screen)
  rm screen message
  left=$(ls -A)
  [ -z "$left" ] || fail "files are left behind: $left"
}
refused "$options"
if [ "$banner" -gt 0 ] && ! grep -q '^# NOT BY CHECK: ' "$file" && [[ $options != *--check* ]]; then
  refused "$options --check"
fi
