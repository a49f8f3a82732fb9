# Sets opacity_INTERFACE: the version, and a digest of the public headers. A plugin holds objects whose layout these
# headers say, so that it fits the engine that was built with the same, and no other; a number would have to be thought of.
file(GLOB_RECURSE opacity_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cpp/include/*.hpp)
list(SORT opacity_headers)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${opacity_headers})
set(opacity_digests "")
foreach(header IN LISTS opacity_headers)
    file(SHA256 ${header} digest)
    string(APPEND opacity_digests ${digest})
endforeach()
string(SHA256 opacity_digest "${opacity_digests}")
string(SUBSTRING ${opacity_digest} 0 12 opacity_digest)
set(opacity_INTERFACE "${PROJECT_VERSION} (headers ${opacity_digest})")
