# SPDX-License-Identifier: BSD-3-Clause
"""The site from the Markdown that is there: sphinx-build -c share/site SOURCE_DIR OUT_DIR."""
import pathlib
import re

_root = pathlib.Path(__file__).resolve().parents[2]
project = "PCL6D"
copyright = "2026, the PCL6D authors"
author = "The PCL6D authors"
release = re.search(r"project\(pcl6d VERSION ([0-9.]+)", (_root / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser"]
root_doc = "share/site/index"
source_suffix = {".md": "markdown"}
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "cmake/**.md", "modules/*/README.md",
                    "share/**.md", "test/benchmark/README.md"]
exclude_patterns = ["build", "install", "debian", ".git", "test/house", "**/node_modules"]
myst_heading_anchors = 4
html_theme = "furo"
html_title = f"PCL6D {release}"
html_static_path = []
html_show_sphinx = False
highlight_language = "none"


def _link_documents(app, document, content):
    """A link to a folder leads to its README, or is left as text where it has none."""
    folder = pathlib.Path(app.env.doc2path(document)).parent

    def changed(link):
        place = folder / link[2]
        if not link[2] or not place.is_dir():
            return link[0]
        return f"[{link[1]}]({link[2]}/README.md)" if (place / "README.md").exists() else link[1]

    content[0] = re.sub(r"\[([^\]]+)\]\(([^)#:\s]*)\)", changed, content[0])


def setup(app):
    app.connect("source-read", _link_documents)
