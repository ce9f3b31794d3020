#!/bin/sh
# SPDX-License-Identifier: MIT
# Usage: check_json.sh TEST_TABLE: the JSON table read by Python; 77 = skipped
command -v python3 >/dev/null || exit 77
"$1" json | python3 -m json.tool >/dev/null
