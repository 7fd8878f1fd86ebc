#pragma once

/// What is seen of the shared library from outside; all else is hidden, so that nothing of ours, or
/// of the libraries inside, stands in for a host's own functions. Put on classes and functions that
/// are defined in a source file and used by a program; errors carry it to be caught outside.
#if defined(__GNUC__)
#define POLYLOC_EXPORT __attribute__((visibility("default")))
#else
#define POLYLOC_EXPORT
#endif
