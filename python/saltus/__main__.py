"""The command line, as `python -m saltus`."""

import sys

from saltus.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
