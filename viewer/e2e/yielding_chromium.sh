#!/bin/sh
# Chromium at a lower priority than the servers under test: its threads, and its session where Linux groups by sessions.
{ echo 5 >/proc/self/autogroup; } 2>/dev/null
exec nice -n 5 "${HL_CHROMIUM:-/usr/bin/chromium}" "$@"
