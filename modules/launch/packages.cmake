# cpack makes limbcast-tools (programs, units, settings), limbcast-dev (types for C++) and limbcast-java (types for
# lcm-spy and Java) for Debian 12.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR limbcast)
set(CPACK_PACKAGE_CONTACT "limbcast maintainers <maintainers@limbcast.invalid>")
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_PREFIX /usr)
# Settings are installed in /etc, whatever the prefix.
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL tools settings dev java)
set(CPACK_COMPONENT_SETTINGS_GROUP tools)
set(CPACK_COMPONENT_TOOLS_GROUP tools)
set(CPACK_COMPONENT_DEV_GROUP dev)
set(CPACK_COMPONENT_JAVA_GROUP java)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
if(NOT TARGET limbcast_lcmtypes_jar)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL java)
endif()

# The programs carry the pose network, which has a licence of its own.
file(READ LICENSE limbcast_license)
file(READ modules/segmenter/models/NOTICE network_notice)
file(READ modules/segmenter/models/LICENSE.Apache-2.0 network_license)
file(CONFIGURE OUTPUT copyright_of_tools CONTENT "${limbcast_license}\n${network_notice}\n${network_license}" @ONLY)
foreach(package tools dev java)
  set(copyright LICENSE)
  if(package STREQUAL tools)
    set(copyright "${CMAKE_CURRENT_BINARY_DIR}/copyright_of_tools")
  endif()
  install(FILES "${copyright}" RENAME copyright
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/limbcast-${package}" COMPONENT ${package})
endforeach()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME limbcast-tools)
set(CPACK_DEBIAN_TOOLS_DESCRIPTION
    "Programs for stereo and depth cameras, laser scanners, replay and viewing, and systemd units that start them.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "liblcm-bin, iproute2")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS limbcast-java)
set(CPACK_DEBIAN_TOOLS_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_LIST_DIR}/packages/conffiles;${CMAKE_CURRENT_LIST_DIR}/packages/postinst")
set(CPACK_DEBIAN_TOOLS_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME limbcast-dev)
set(CPACK_DEBIAN_DEV_DESCRIPTION
    "The messages for programs of your own: C++ types, CMake and pkg-config files, the .lcm files, examples.")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS liblcm-dev)

set(CPACK_DEBIAN_JAVA_PACKAGE_NAME limbcast-java)
set(CPACK_DEBIAN_JAVA_DESCRIPTION
    "The messages for Java: for lcm-spy, which limbcast-spy starts with them, and programs of your own.")
set(CPACK_DEBIAN_JAVA_PACKAGE_SECTION java)
set(CPACK_DEBIAN_JAVA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_JAVA_PACKAGE_DEPENDS "liblcm-java, libjchart2d-java, default-jre")

include(CPack)
