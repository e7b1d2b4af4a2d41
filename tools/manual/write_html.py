#!/usr/bin/env python3
"""Writes the manual as HTML that is read from disk, equations as MathML; run by tools/docs.sh.

    write_html.py BUILD OUT      BUILD/manual-venv has the parsers, or is made
"""
import os
import pathlib
import shutil
import sys
import urllib.parse

import check

STYLE = """
body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; font: 16px/1.5 sans-serif; color: #1b1f23; }
pre { background: #f5f6f7; padding: .8rem; overflow-x: auto; } code { background: #f5f6f7; font-size: 14px; }
table { border-collapse: collapse; display: block; overflow-x: auto; margin: 1rem 0; }
td, th { border: 1px solid #ccd; padding: .3rem .6rem; }
img { max-width: 100%; } nav { font-size: 14px; border-bottom: 1px solid #ccd; padding-bottom: .5rem; }
"""


def target_of(page, href, pages, out):
    """Where a link leads in the written manual; files that are no pages are copied there. None: nowhere."""
    url = urllib.parse.urlsplit(href)
    if url.scheme or url.netloc or not url.path:
        return href
    path = (page.path.parent / urllib.parse.unquote(url.path)).resolve()
    name = path.relative_to(page.root)
    if path.is_dir():
        return None
    if path not in pages:
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, out / name)
    written = name.with_suffix(".html") if path in pages else name
    relative = os.path.relpath(out / written, (out / page.name).parent)
    return relative + (f"#{url.fragment}" if url.fragment else "")


def write(page, pages, out):
    import latex2mathml.converter
    import markdown_it
    import pages as pages_module

    seen = {}
    for i, token in enumerate(page.tokens):
        if token.type == "heading_open":
            anchor = page.anchor(pages_module.plain(page.tokens[i + 1]), seen)
            token.attrSet("id", anchor)
        for child in token.children or []:
            attribute = {"link_open": "href", "image": "src"}.get(child.type)
            if attribute:
                href = target_of(page, child.attrGet(attribute), pages, out)
                # A directory cannot be shown; its name can.
                child.attrs.pop(attribute) if href is None else child.attrSet(attribute, href)

    def fence(renderer, tokens, index, options, env):
        token = tokens[index]
        if token.info.strip() == "math":
            return f"<p>{latex2mathml.converter.convert(token.content, display='block')}</p>\n"
        return renderer.fence(tokens, index, options, env)

    parser = markdown_it.MarkdownIt("commonmark").enable("table")
    parser.add_render_rule("fence", fence)
    body = parser.renderer.render(page.tokens, parser.options, {})
    index = os.path.relpath(out / "docs/README.html", (out / page.name).parent)
    path = (out / page.name).with_suffix(".html")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">\n<title>gentrack2: {page.name}</title>\n'
                    f'<meta name="viewport" content="width=device-width">\n<style>{STYLE}</style>\n'
                    f'<nav><a href="{index}">gentrack2: the manual</a></nav>\n{body}</html>\n')
    return path


def main():
    build, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    check.enter(build)
    import links
    import pages as pages_module
    all_pages = pages_module.manual() + pages_module.beside()
    if wrong := list(links.check(all_pages)):
        sys.exit("\n".join(wrong))
    known = {page.path.resolve() for page in all_pages}
    written = [write(page, known, out) for page in all_pages]
    print(f"{len(written)} pages, {out / 'docs/README.html'}")


if __name__ == "__main__":
    main()
