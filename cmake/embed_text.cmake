# lensgraph_embed_text(OUTPUT FILE…): writes the bytes of the files, one file after the other, and a zero for #include
# between the braces of a char array. Not as string literals: compilers need accept no more than 64 KiB of those.
function(lensgraph_embed_text output)
  set(bytes "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} content HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," content "${content}")
    string(APPEND bytes "${content}\n")
  endforeach()
  file(GENERATE OUTPUT ${output} CONTENT "${bytes}0\n")
endfunction()
