# The warnings all our targets are compiled with; errors where POLYLOC_WERROR is on (preset dev,
# and the gate by way of the environment).
add_library(polyloc_warnings INTERFACE)
target_compile_options(polyloc_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                                  $<$<BOOL:${POLYLOC_WERROR}>:-Werror>)
if(CMAKE_UNITY_BUILD)
  # A class of a source file may have members of types that are that file's own; in files that are
  # joined, g++ takes it for a header's.
  target_compile_options(polyloc_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
