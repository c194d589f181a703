#include <graze/graze.hpp>

int main() {}
