# SPDX-License-Identifier: BSD-3-Clause
"""The site from the Markdown that is there, and from the pages of program_pages.py:
sphinx-build -c share/site -D pcl6d_tag_file=TAG_FILE_OF_DOXYGEN FOLDER_OF_PAGES OUT_DIR
(the target `site` does so)."""
import pathlib
import re
import sys

_root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(_root / "share/site"))
sys.dont_write_bytecode = True  # the sources may be read-only

project = "PCL6D"
copyright = "2026, the PCL6D authors"
author = "The PCL6D authors"
release = re.search(r"project\(pcl6d VERSION ([0-9.]+)", (_root / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "site_extension"]
root_doc = "share/site/index"
source_suffix = {".md": "markdown"}
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "modules/*/README.md",
                    "programs/*.md", "share/**.md", "test/benchmark/README.md"]
exclude_patterns = ["build", "install", "debian", ".git", "test/house", "**/node_modules"]
myst_heading_anchors = 4
html_theme = "furo"
html_title = f"PCL6D {release}"
html_static_path = ["static"]
html_css_files = ["pcl6d.css"]
html_js_files = ["pcl6d.js"]
# Each colour of these two has enough contrast.
pygments_style = "default"
pygments_dark_style = "github-dark"
html_show_sphinx = False
highlight_language = "none"


def _link_documents(app, document, content):
    """A link to a folder leads to its README, or is left as text where it has none. The name of a
    class with a link to its header becomes a link to its page by Doxygen (site_extension.py)."""
    folder = pathlib.Path(app.env.doc2path(document)).parent

    def changed(link):
        place = folder / link[2]
        if link[2].endswith(".h") and link[1].startswith("`"):
            return link[1]
        if not link[2] or not place.is_dir():
            return link[0]
        return f"[{link[1]}]({link[2]}/README.md)" if (place / "README.md").exists() else link[1]

    content[0] = re.sub(r"\[([^\]]+)\]\(([^)#:\s]*)\)", changed, content[0])


def setup(app):
    app.connect("source-read", _link_documents)
