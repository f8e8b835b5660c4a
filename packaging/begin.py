"""Where the application begins; its workers are processes of the same program."""

from multiprocessing import freeze_support

if __name__ == "__main__":
    freeze_support()
    from shaketable.__main__ import main

    main()
