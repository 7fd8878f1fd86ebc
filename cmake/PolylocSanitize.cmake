# POLYLOC_SANITIZE=address,undefined or =thread: the whole build under g++'s sanitizers (presets
# asan and tsan). The first finding ends the program, so that a test cannot pass over it.
set(POLYLOC_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread; empty: none")
if(POLYLOC_SANITIZE)
  add_compile_options("-fsanitize=${POLYLOC_SANITIZE}" -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  # Sanitized code confuses g++ 12's search for uninitialized values: it warns about CGAL's kernel.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options("-fsanitize=${POLYLOC_SANITIZE}")
endif()
