# SPDX-License-Identifier: BSD-3-Clause
"""What the pages of the site have beyond Markdown: links from the names of classes to their pages
by Doxygen, one task in several languages side by side, and corrections of the theme."""
import pathlib
import posixpath
import re
import xml.etree.ElementTree

from docutils import nodes
from sphinx.directives.code import LiteralInclude
from sphinx.util.docutils import SphinxDirective

# Pages where a name without `pcl6d::` may be a class of Python, of another library or of the past.
OTHER_NAMES = re.compile(r"modules/python/|share/doc/from_|share/doc/pcl_classes|CHANGELOG")
LANGUAGES = [("command", ".sh", "sh"), ("C++", ".cpp", "cpp"), ("Python", ".py", "python")]


def pages_of_classes(tag_file):
    """The page of each class of namespace pcl6d by its name, with and without the namespace."""
    pages = {}
    for compound in xml.etree.ElementTree.parse(tag_file).getroot().iterfind("compound"):
        name = compound.findtext("name")
        if compound.get("kind") in ("class", "struct") and re.fullmatch(r"pcl6d::\w+", name):
            pages[name] = pages[name[len("pcl6d::"):]] = compound.findtext("filename")
    return pages


def link_classes(app, doctree, document):
    """`pcl6d::Name` and `Name` in the text become links, once in a section."""
    folder = posixpath.relpath("api", posixpath.dirname(document) or ".")
    linked = set()
    for literal in list(doctree.findall(nodes.literal)):
        name = re.sub(r"<.*>$", "", literal.astext())  # without template arguments
        page = app.env.pcl6d_classes.get(name)
        section = literal.parent
        while section.parent is not None and not isinstance(section, nodes.section):
            section = section.parent
        is_other = "::" not in name and OTHER_NAMES.match(document)
        is_in_link = isinstance(literal.parent, (nodes.reference, nodes.title))
        if not page or is_other or is_in_link or (id(section), name) in linked:
            continue
        linked.add((id(section), name))
        link = nodes.reference("", "", refuri=f"{folder}/{page}", internal=True)
        literal.replace_self(link)
        link += literal


def read_classes(app):
    """Without the tag file of Doxygen, names of classes stay text."""
    tag_file = app.config.pcl6d_tag_file
    app.env.pcl6d_classes = pages_of_classes(tag_file) if tag_file else {}


class Languages(SphinxDirective):
    """A task as a command, in C++ and in Python, of which one is shown:

    ```{languages} CPP SH PY
    ```

    names the files of share/examples without their extension, or one name for all of them. Each
    is shown from its first line of code on. Works without scripts: radio buttons and CSS."""

    required_arguments = 1
    optional_arguments = 2

    def run(self):
        group = f"languages-{self.env.new_serialno('languages')}"
        box = nodes.container(classes=["languages"])
        for (title, ending, language), name in zip(LANGUAGES, self.names()):
            button = f"{group}-{language}"
            checked = " checked" if language == "sh" else ""
            box += nodes.raw("", f'<input type="radio" name="{group}" id="{button}"{checked}>'
                                 f'<label for="{button}">{title}</label>', format="html")
            panel = nodes.container(classes=["language", f"language-{language}"])
            panel += self.included(name + ending, language)
            box += panel
        return [box]

    def names(self):
        return self.arguments if len(self.arguments) == 3 else self.arguments[:1] * 3

    def included(self, name, language):
        path = f"/share/examples/{name}"
        text = (pathlib.Path(self.env.srcdir) / path[1:]).read_text().split("\n")
        first = next(i for i, line in enumerate(text, 1) if line and not re.match(r"#!|(#|//) SPDX", line))
        include = LiteralInclude("literalinclude", [path],
                                 {"language": language, "lines": f"{first}-", "caption": f"share{path[6:]}"},
                                 self.content, self.lineno, self.content_offset, "", self.state,
                                 self.state_machine)
        return include.run()


def level_captions(app, page, template, context, doctree):
    """Captions of lists of pages are headings, which need a level for readers of the screen."""
    for part in ("body", "furo_navigation_tree"):
        if part in context:
            context[part] = context[part].replace('role="heading">', 'role="heading" aria-level="2">')


def mend_theme(app, error):
    """Debian's furo asks for a style sheet at the root of the server, imports a script where none
    can be imported, and has lost the rule that a browser set to dark colours shows dark pages.
    All three come into the site here."""
    static = pathlib.Path(app.outdir) / "_static"
    style, script = static / "styles/furo.css", static / "scripts/furo.js"
    if error or app.builder.format != "html":
        return
    match = re.match(r"@import url\((/javascript/[^)]*)\);\n", style.read_text())
    if match:
        base = pathlib.Path("/usr/share" + match[1])
        style.write_text((base.read_text() if base.exists() else "") + style.read_text()[match.end():])
    sheet = style.read_text()
    dark = re.search(r'body\[data-theme="dark"\] \{([^}]*)\}', sheet)
    if dark and "prefers-color-scheme" not in sheet:
        rule = f'body:not([data-theme="light"]) {{{dark[1]}}}'
        style.write_text(f"{sheet}\n@media not print {{ @media (prefers-color-scheme: dark) {{ {rule} }} }}\n")
    match = re.match(r'import \w+ from "\./([\w.-]+)";\n', script.read_text())
    if match:
        script.write_text((script.parent / match[1]).read_text() + script.read_text()[match.end():])


def setup(app):
    app.add_config_value("pcl6d_tag_file", "", "env")
    app.add_directive("languages", Languages)
    app.connect("builder-inited", read_classes)
    app.connect("doctree-resolved", link_classes)
    app.connect("html-page-context", level_captions, priority=900)  # after furo
    app.connect("build-finished", mend_theme)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
