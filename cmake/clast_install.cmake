# SPDX-License-Identifier: MIT
# Install rules and the package that find_package(clast) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/clast")
install(
    TARGETS clast clast_fast
    EXPORT clast_targets
    FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(
    EXPORT clast_targets
    NAMESPACE clast::
    DESTINATION "${package_dir}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/clast-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/clast-config.cmake" INSTALL_DESTINATION "${package_dir}")
# Headers fit any architecture; before 1.0 a minor version may break the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/clast-config-version.cmake" COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/clast-config.cmake" "${PROJECT_BINARY_DIR}/clast-config-version.cmake"
        DESTINATION "${package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/clast")
