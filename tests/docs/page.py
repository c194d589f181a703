"""One page of Markdown: its prose, code blocks, links and anchors, each with its line."""

import re


class Page:
    """A page as it is read from its file. Lines are counted from 1."""

    def __init__(self, path, shown_name):
        self.path = path
        self.name = shown_name
        self.blocks = []  # (line of the first line of code, language, text)
        self.anchors = set()
        prose = self._split(path.read_text(encoding="utf-8").split("\n"))
        # A comment is read for no names: nobody sees it.
        text = re.sub(r"<!--.*?-->", lambda found: re.sub(r"[^\n]", " ", found.group(0)), "\n".join(prose), flags=re.S)
        self.text = text  # the prose, with line breaks where the file has them
        self._read_spans(text)
        self._read_anchors(text)

    def _split(self, lines):
        """Takes out code blocks, and returns the lines with empty ones in their place."""
        prose = []
        fence, language, code, first = None, "", [], 0
        indented, blank_before = False, True
        for number, line in enumerate(lines, 1):
            mark = re.match(r"^\s*(`{3,}|~{3,})\s*([\w+-]*)", line)
            if fence:
                if mark and mark.group(1).startswith(fence) and not mark.group(2):
                    self.blocks.append((first, language, "\n".join(code)))
                    fence = None
                else:
                    code.append(line)
                prose.append("")
                continue
            if mark:
                fence, language, code, first = mark.group(1), mark.group(2), [], number + 1
                prose.append("")
                indented = False
                continue
            if line.startswith("    ") and line.strip() and (indented or blank_before):
                if not indented:
                    indented, code, first = True, [], number
                    self.blocks.append((first, "indented", ""))
                code.append(line[4:])
                self.blocks[-1] = (first, "indented", "\n".join(code))
                prose.append("")
                blank_before = False
                continue
            indented = indented and not line.strip()
            blank_before = not line.strip()
            prose.append(line)
        return prose

    def _read_spans(self, text):
        """Finds what stands in backticks, and links outside of it."""
        self.spans, self.links = [], []

        def line_of(offset):
            return text.count("\n", 0, offset) + 1

        def hide(found):
            content = found.group(2)
            self.spans.append((line_of(found.start()), " ".join(content.split())))
            return found.group(1) + re.sub(r"[^\n]", "x", content) + found.group(1)

        plain = re.sub(r"(?<!`)(`+)(?!`)((?:(?!\n\n).)+?)(?<!`)\1(?!`)", hide, text, flags=re.S)
        for found in re.finditer(r"(!?)\[[^\]]*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)", plain):
            self.links.append((line_of(found.start()), found.group(2), bool(found.group(1))))
        for found in re.finditer(r"^\[[^\]]+\]:\s*(\S+)", plain, flags=re.M):
            self.links.append((line_of(found.start()), found.group(1), False))
        for found in re.finditer(r"<(img|a)\b[^>]*?\b(?:src|href)=\"([^\"]+)\"", plain):
            self.links.append((line_of(found.start()), found.group(2), found.group(1) == "img"))

    def _read_anchors(self, text):
        """The anchors that GitHub gives to headings, and those that stand in the page as HTML."""
        seen = {}
        for found in re.finditer(r"^#{1,6}\s+(.*?)\s*#*\s*$", text, flags=re.M):
            slug = slug_of(found.group(1))
            count = seen.get(slug, 0)
            seen[slug] = count + 1
            self.anchors.add(slug if count == 0 else f"{slug}-{count}")
        self.anchors.update(re.findall(r"<a\s+(?:id|name)=\"([^\"]+)\"", text))


def slug_of(heading):
    """GitHub's anchor for a heading."""
    heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    heading = re.sub(r"[`*]", "", heading).lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")
