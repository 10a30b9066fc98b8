#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether each link within a site leads to a file and an anchor that are there. Links on the pages
of Doxygen, below api/, are its own matter; links to these pages are checked.
usage: check_links.py FOLDER
"""
import pathlib
import re
import sys
import urllib.parse


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    anchors, links = {}, {}
    for page in root.rglob("*.html"):
        text = page.read_text()
        anchors[page] = set(re.findall(r'\b(?:id|name)="([^"]+)"', text))
        if "api" not in page.relative_to(root).parts[:1]:
            links[page] = re.findall(r'\b(?:href|src)="([^"]+)"', text)
    dead = count = 0
    for page, targets in links.items():
        for target in targets:
            if re.match(r"[a-z]+:", target):
                continue  # another site
            count += 1
            path, _, anchor = target.partition("#")
            file = (page.parent / urllib.parse.unquote(path.split("?")[0])).resolve() if path else page
            if not file.exists():
                fault = "no such file"
            elif anchor and file in anchors and urllib.parse.unquote(anchor) not in anchors[file]:
                fault = "no such anchor"
            else:
                continue
            dead += 1
            print(f"{page.relative_to(root)}: {target}: {fault}")
    print(f"{len(links)} pages, {count} links, {dead} dead")
    sys.exit(1 if dead or len(links) < 10 else 0)


if __name__ == "__main__":
    main()
