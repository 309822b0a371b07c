"""Numbers of things in messages: '1 contact', '2,000 contacts'."""


def counted(number: int, noun: str) -> str:
    """So many of something whose plural ends in -s."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"
