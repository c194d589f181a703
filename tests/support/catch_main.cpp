// Catch2 v2 brings main() as a header. v3 has a library for it (catch.cmake).
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
