"""Programs that time one peer's steps each; a process of its own for every peer.

Two peers in one process could load different versions of one C++ library.
"""
