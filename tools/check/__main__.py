"""python3 tools/check [NAME …]: checks of form, in seconds; without names all but the examples, as tools/lint runs them.

  includes  each folder includes only what stands below it, nothing in a circle; foreign libraries only where they belong; files per folder
  tests     each unit has a test, beside it in the mirror of the tree or in a row that names another and why
  draws     one random draw per statement
  names     what an anonymous namespace names is named once in its folder
  headers   no header is too large; headers HEADER: through which others it is read
  parts     cmake/parts.csv names every part of others that CMake looks for, with its licence
  links     links of README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md, and the paths that they name
  words     no retired word, one spelling
  examples  commands, keys and TOML blocks of the pages; examples PROGRAM: another than build/release/belvedere

Prints FILE:LINE: what is wrong. Exit status 1 where something is.
"""
import sys

sys.dont_write_bytecode = True  # checks leave nothing in the checkout
import examples
import pages
import parts
import sources
import tests

# Each returns what is wrong, and what it says at its end; the last two may be given one word more.
checks = {
    "includes": sources.check_includes,
    "tests": tests.check_tests,
    "draws": sources.check_draws,
    "names": sources.check_names,
    "parts": parts.check_parts,
    "links": pages.check_links,
    "words": pages.check_words,
    "headers": sources.check_headers,
    "examples": examples.check_examples,
}


def main():
    chosen, last = {}, ""
    for word in sys.argv[1:]:
        if word in checks:
            chosen[word], last = [], word
        elif last in ("headers", "examples") and not chosen[last]:
            chosen[last] = [word]
        else:
            print(f'unknown check "{word}": {", ".join(checks)}', file=sys.stderr)
            return 2
    failed = False
    for name in chosen or [name for name in checks if name != "examples"]:
        faults, said = checks[name](*chosen.get(name, []))
        for fault in faults:
            print(fault, file=sys.stderr)
        if said:
            print(said, flush=True)
        failed |= bool(faults)
    return 1 if failed else 0


sys.exit(main())
