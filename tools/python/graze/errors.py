"""The exception that calls raise."""


class Error(ValueError):
    """Is raised for input that graze refuses, with a sentence that says what is wrong.

    A call that raises has changed nothing. `MemoryError` is raised where there is no memory.
    """
