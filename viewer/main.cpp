// The vitrine program.
#include "viewer/commands/commands.h"

int main(int argc, char** argv) { return viewer::runProgram(argc, argv); }
