# Makes a file part of a C program: cmake -DINPUT=... -DOUTPUT=... -DHEADER=... -DNAME=... -P embed.cmake
# writes a C file with the bytes as NAME and their number as NAME_size, declared in HEADER.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\nconst unsigned char ${NAME}[] = {${bytes}};\nconst size_t ${NAME}_size = sizeof ${NAME};\n")
