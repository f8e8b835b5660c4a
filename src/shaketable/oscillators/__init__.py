"""Linear oscillators, for response spectra and spectral matching.

They are compiled apart from the contact kernels, so that an edit here recompiles nothing else.
"""
