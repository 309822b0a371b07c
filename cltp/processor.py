"""What this processor does for torch, numpy and scipy: how many threads, in which number formats.

Importing it loads no torch.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import ThreadpoolController


@contextmanager
def torch_threads(count: int = 1) -> Iterator[None]:
    """Let torch compute on ``count`` threads; also a decorator.

    One thread suits work that is too small to share: on a busy machine, threads that wait for each
    other have taken twenty times as long. The order of sums, and so the last bits of a result,
    depends on the number of threads.
    """
    import torch

    before = torch.get_num_threads()
    torch.set_num_threads(count)
    try:
        yield
    finally:
        torch.set_num_threads(before)


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let linear algebra of numpy and scipy compute on one thread; also a decorator.

    ``scipy.spatial.Delaunay`` solves two equations for each triangle, and OpenBLAS wakes all its
    threads for each: among 1024 points that takes 4 ms, and 16 s while other work keeps one of two
    cores busy.
    """
    with _linear_algebra().limit(limits=1, user_api="blas"):
        yield


@functools.cache
def _linear_algebra() -> ThreadpoolController:
    import scipy.linalg  # noqa: F401  # scipy's library is found only once it is loaded

    return ThreadpoolController()


@functools.cache
def has_bfloat16() -> bool:
    """Whether this processor has instructions for products of matrices in bfloat16.

    Without them torch takes ten times as long for such a product as in 32 bits.
    """
    import torch

    known = torch.cpu.get_capabilities()
    return any(known.get(name, False) for name in ("avx512_bf16", "amx_bf16"))
