#!/usr/bin/env python3
"""The German catalogue has every text of the window and of the engine's events, with the same places for values.

usage: translation_test.py SOURCE_TREE [--all]    (--all prints every text that is looked for, as JSON)
"""
import json
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

LITERAL = r'"((?:[^"\\]|\\.)*)"'
LITERALS = r'(?:%s\s*)+' % LITERAL
CALLS = re.compile(r'\b(?:(?:tr|QT_TR_NOOP)\(\s*|(?:translate|QT_TRANSLATE_NOOP)\(\s*"[\w:]+"\s*,\s*)(%s)\s*[,)]' % LITERALS)
# Where the engine's words for people are, and what of them is none.
ENGINE = ["engine/pipeline/announcer.cpp", "engine/flight/autopilot.cpp", "engine/pipeline/engine.cpp",
          "engine/flight/flight_state.cpp", "engine/pipeline/control_set.cpp",
          "engine/transmitter/channel_measurement.cpp", "engine/transmitter/direction_check.cpp"]
NO_TEXT = re.compile(r'^[^a-zA-Z]*$|^%s|%s|\.h$|^engine/|^[a-z_-]+$')


def unescaped(text):
    return json.loads('"' + re.sub(r"\\'", "'", text) + '"')


def joined(literals):
    return "".join(unescaped(part) for part in re.findall(LITERAL, literals))


def window_texts(tree):
    found = {}
    for file in sorted((tree / "ui").glob("*.cpp")) + sorted((tree / "ui").glob("*.h")):
        for match in CALLS.finditer(file.read_text()):
            found.setdefault(joined(match.group(1)), file.name)
    return found


def engine_texts(tree):
    found = {}
    for name in ENGINE:
        text = (tree / name).read_text()
        for statement in re.findall(r'(?:raise|raise_if|event|return|snprintf|throw Error)\b(?:[^;"]|"(?:[^"\\]|\\.)*")*;', text):
            for match in re.finditer(LITERALS, statement):
                value = joined(match.group(0))
                if value.endswith(": %s"):
                    value = value.removesuffix(" %s")
                if value == "calibrates anew by %s":
                    value = "calibrates anew by "
                if not NO_TEXT.search(value):
                    found.setdefault(value, Path(name).name)
    return found


def catalogue(tree):
    root = xml.parse(tree / "resources/translations/helical_de.ts").getroot()
    texts = {}
    for message in root.iter("message"):
        source, translation = message.findtext("source"), message.find("translation")
        if source in texts:
            sys.exit(f"twice in the catalogue: {source!r}")
        texts[source] = "" if translation.get("type") == "unfinished" else (translation.text or "")
    return texts


def main():
    tree = Path(sys.argv[1])
    wanted = {**engine_texts(tree), **window_texts(tree)}
    german = catalogue(tree) if (tree / "resources/translations/helical_de.ts").exists() else {}
    missing = {text: where for text, where in wanted.items() if text.strip() and not german.get(text)}
    if "--all" in sys.argv:
        for text in wanted:
            if text.strip():
                print(json.dumps(text, ensure_ascii=False))
        return
    problems = [f"{where}: no German for {text!r}" for text, where in missing.items()]
    for text, translation in german.items():
        if sorted(re.findall(r"%\d", text)) != sorted(re.findall(r"%\d", translation)):
            problems.append(f"other places for values: {text!r}, {translation!r}")
        if text.startswith("&") != translation.startswith("&") and text.count("&") != translation.count("&"):
            problems.append(f"no key for the menu: {translation!r}")
    if len(wanted) < 200:
        problems.append(f"found only {len(wanted)} texts: the search is broken")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(wanted)} texts")


main()
