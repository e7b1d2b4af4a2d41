"""Links within the repository lead somewhere: to a file, and to a heading that is there."""
import urllib.parse


def check(pages):
    """What is wrong, one line each; links to other sites are not followed."""
    known = {page.path.resolve(): page for page in pages}
    for page in pages:
        for line, href, _ in page.links:
            url = urllib.parse.urlsplit(href)
            if url.scheme or url.netloc:
                continue
            target = (page.path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page.path.resolve()
            if page.root.resolve() not in [target, *target.parents]:
                yield f"{page.name}:{line}: {href}: leads out of the repository"
            elif not target.exists():
                yield f"{page.name}:{line}: {href}: there is no such file"
            elif url.fragment and target in known and url.fragment not in known[target].anchors:
                yield f"{page.name}:{line}: {href}: that page has no such heading"


def unreachable(pages, start):
    """Pages to which no chain of links leads from the first one."""
    known = {page.path.resolve(): page for page in pages}
    found, ahead = set(), [start]
    while ahead:
        page = ahead.pop()
        if page.name in found:
            continue
        found.add(page.name)
        targets = ((page.path.parent / href.split("#")[0]).resolve() for _, href, _ in page.links if href)
        ahead += [known[target] for target in targets if target in known]
    return [page.name for page in pages if page.name not in found]
