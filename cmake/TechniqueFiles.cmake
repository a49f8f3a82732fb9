# opacity_technique_files(caller name directory shader_directory class_variable): the three files of a technique are there,
# and deep_opacity_maps has the class DeepOpacityMaps. Without a shader directory two files are all.
function(opacity_technique_files caller name directory shader_directory class_variable)
    set(files ${directory}/${name}.hpp ${directory}/${name}.cpp)
    if(shader_directory)
        list(APPEND files ${shader_directory}/${name}.glsl)
    endif()
    foreach(file ${files})
        if(NOT EXISTS ${file})
            message(FATAL_ERROR "${caller}(${name}): ${file} is missing.\n"
                "  fix: add it, or take out the line. A technique is ${name}.hpp and ${name}.cpp in ${directory}, and "
                "${name}.glsl in ${shader_directory}; start from a copy of unshadowed's three.")
        endif()
    endforeach()

    set(class "")
    string(REPLACE "_" ";" words ${name})
    foreach(word ${words})
        string(SUBSTRING ${word} 0 1 first)
        string(SUBSTRING ${word} 1 -1 rest)
        string(TOUPPER ${first} first)
        string(APPEND class ${first}${rest})
    endforeach()
    set(${class_variable} ${class} PARENT_SCOPE)
endfunction()
