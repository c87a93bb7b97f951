# lensgraph_embed_text(OUTPUT FILE…): writes C++ string literals of the files' content, one after the other, for
# #include as one initializer. The files are text without the sequence )text".
function(lensgraph_embed_text output)
  set(literals "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} content)
    string(APPEND literals "R\"text(${content})text\"\n")
  endforeach()
  file(GENERATE OUTPUT ${output} CONTENT "${literals}")
endfunction()
