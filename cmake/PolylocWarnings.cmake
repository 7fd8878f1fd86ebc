# The warnings all our targets are compiled with; errors where POLYLOC_WERROR is on (preset dev,
# and the gate by way of the environment).
add_library(polyloc_warnings INTERFACE)
target_compile_options(polyloc_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                                  $<$<BOOL:${POLYLOC_WERROR}>:-Werror>)
