"""Hooks of mkdocs (mkdocs.yml, tools/docs): CONTRIBUTING.md, CHANGELOG.md and SECURITY.md are pages too, and links between them and docs/ work."""
import pathlib
import re

from mkdocs.structure.files import File

root = pathlib.Path(__file__).resolve().parent.parent
further = ("CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")


def on_files(files, config):
    for name in further:
        files.append(File(name, str(root), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_markdown(markdown, page, config, files):
    """Links of the repository become links to pages of the site; links to other files are reduced to their text."""
    folder = root if page.file.src_path in further else root / "docs"

    def on_site(link):
        text, target, anchor = link.groups()
        path = (folder / target).resolve()
        if not path.exists():
            return link.group(0)  # mkdocs reports it
        if path == root / "README.md":
            path = root / "docs/index.md"
        if path.parent == root and path.name in further:
            return f"{text}({path.name}{anchor})"
        if path.is_relative_to(root / "docs"):
            return f"{text}({path.relative_to(root / 'docs')}{anchor})"
        return text[1:-1]

    return re.sub(r"(\[[^\[\]]*\])\((?![a-z]+:)([^()#\s]+)((?:#[^()\s]*)?)\)", on_site, markdown)
