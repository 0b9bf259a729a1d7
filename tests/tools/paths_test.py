#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails where a built file holds the name of a folder of the machine that built it.

usage: paths_test.py FOLDER... -- FILE...
"""
import os
import sys


def main():
    split = sys.argv.index("--")
    folders, files = sys.argv[1:split], sys.argv[split + 1:]
    # the folder of the user, where it is not a name that any text may hold
    home = os.path.expanduser("~")
    if home.count("/") > 1:
        folders.append(home)
    assert folders and len(files) > 10, "nothing to look for, or nowhere to look"
    faults = 0
    for name in files:
        with open(name, "rb") as file:
            content = file.read()
        for folder in folders:
            at = content.find(folder.encode() + b"/")
            if at >= 0:
                faults += 1
                print(f"{name}: {content[at:at + 120].split(bytes(1))[0].decode(errors='replace')}")
    print(f"{len(files)} files, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
