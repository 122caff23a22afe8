"""The program `ripstop` of a wheel: its command `ripstop`, and `python -m ripstop`."""
import os
import pathlib
import sys

import ripstop  # sets RIPSTOP_DATA to the data of the wheel

PROGRAM = pathlib.Path(ripstop.__file__).parent / "bin/ripstop"


def main():
    if not PROGRAM.exists():
        sys.exit("this installation of the Python package does not contain the program; a wheel does")
    os.execv(PROGRAM, [str(PROGRAM), *sys.argv[1:]])


if __name__ == "__main__":
    main()
