"""Is the page that the given program writes well-formed, complete in itself and free of all scripts
but its own, which its policy must name by its hash?

usage: check_page.py PROGRAM with|without|wanted [PROGRAM with|without that must write the same]
"""

import base64
import hashlib
import json
import re
import subprocess
import sys
import xml.etree.ElementTree
import zlib
from html.parser import HTMLParser

VOID = {"meta", "input", "br", "hr", "img", "link"}
SVG = {"use", "circle", "path", "line", "rect", "polygon"}  # may close themselves
ALLOWED_TAGS = """html head meta title style body svg g defs circle path use line rect text header h1 h2
tspan polygon desc h3 h4 h5 caption p span strong ol ul li a dl div dt dd main fieldset legend input label nav section figure
figcaption table thead tbody tr th td details summary noscript footer pre""".split()


class Page(HTMLParser):
    """Keeps the open elements and what breaks the rules."""

    def __init__(self):
        super().__init__()
        self.open, self.faults, self.ids, self.targets = [], [], set(), set()

    def start(self, tag, attributes):
        if tag not in ALLOWED_TAGS:
            self.faults.append(f"element {tag}")
        for name, value in attributes:
            if name.startswith("on") or name in ("src", "srcset", "action", "style"):
                self.faults.append(f"attribute {name}")
            if name == "href":
                if not value.startswith("#"):
                    self.faults.append(f"link to {value}")
                self.targets.add(value[1:])
            if name == "id":
                if value in self.ids:
                    self.faults.append(f"id {value} twice")
                self.ids.add(value)
            if "nan" in str(value).split() or "inf" in str(value).split():
                self.faults.append(f"{name}={value}")

    def handle_starttag(self, tag, attributes):
        self.start(tag, attributes)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.start(tag, attributes)
        if tag not in VOID | SVG:
            self.faults.append(f"{tag} closes itself")

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"unexpected </{tag}>")


def check_scripts(text, faults):
    """Takes out data and scripts, the last things of the body; gives the page without them."""
    found = re.search(
        r'<script type="application/octet-stream" id="slipcheck-data">([A-Za-z0-9+/=]*)</script>\n'
        r'<script type="application/octet-stream" id="slipcheck-script">([A-Za-z0-9+/=]*)</script>\n'
        r"<script>(.*)</script>\n</body>\n</html>\n$", text, re.DOTALL)
    if not found:
        return text
    packed, packed_script, loader = found.groups()
    script = zlib.decompress(base64.b64decode(packed_script))
    digests = [base64.b64encode(hashlib.sha256(source).digest()).decode()
               for source in (loader.encode("utf-8"), script)]
    if "; script-src '{}' '{}';".format(*("sha256-" + d for d in digests)) not in text:
        faults.append("the policy does not name the two scripts")

    def refuse(constant):
        faults.append(f"{constant} in the data")

    data = json.loads(zlib.decompress(base64.b64decode(packed)), parse_constant=refuse)
    if data["schema"] != "slipcheck-page/3":
        faults.append(f"schema {data['schema']}")
    for part, attribute in (("scenes", "data-scene"), ("precision", "data-precision")):
        for k in range(len(data[part])):
            if f'<div class="plots" {attribute}="{k}"></div>' not in text:
                faults.append(f"no plots of {part}[{k}]")
    text = text[: found.start()] + "</body>\n</html>\n"
    # Licences may say where they come from.
    return re.sub(r"<pre[^>]*>.*?</pre>", "", text, flags=re.DOTALL)


def page_of(command):
    return subprocess.run(command, check=True, capture_output=True).stdout.decode("utf-8")


text = page_of(sys.argv[1:3])
script_faults = []
if len(sys.argv) > 3 and text != page_of(sys.argv[3:]):
    script_faults.append(f"not the page of {' '.join(sys.argv[3:])}")
if sys.argv[2] == "with":
    whole = text
    text = check_scripts(text, script_faults)
    if text == whole:
        script_faults.append("no script")
xml.etree.ElementTree.fromstring(text)  # strict about everything
page = Page()
page.feed(text)
page.close()
faults = script_faults + page.faults + [f"<{tag}> left open" for tag in page.open]
faults += [f"no target for #{target}" for target in page.targets - page.ids]
faults += [f"{url} on the page" for url in ("http://", "https://", "url(", "@import") if url in text]
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
