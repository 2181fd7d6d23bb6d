# The README prints the minimal example as it is: cmake -D SOURCE=<project> -P readme.cmake
file(READ ${SOURCE}/README.md readme)
file(READ ${SOURCE}/examples/minimal/main.cpp example)
string(FIND "${readme}" "${example}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md does not hold examples/minimal/main.cpp as it is")
endif()
