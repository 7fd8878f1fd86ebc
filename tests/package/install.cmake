# Installs BUILD_DIR into PREFIX, after removing WORK_DIR: what an earlier run left there must not
# stand in for a file that is no longer installed.
file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${PREFIX}"
                COMMAND_ERROR_IS_FATAL ANY)
