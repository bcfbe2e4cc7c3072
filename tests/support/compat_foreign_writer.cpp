// Writes the scene of tests/compat/foreign_scene.h to standard output. Compiled for another kind of machine it shows what
// files from there look like: tests/compat/data/big_endian.txt came from powerpc64-linux-gnu-g++ (with the headers of
// libsimde-dev in place of emmintrin.h) and qemu-ppc64.
#include "tests/compat/foreign_scene.h"

int main() {
  compat_tests::ForeignScene scene;
  if (scene.create() != SCE_PFX_OK) return 1;
  return compat_tests::writeForeignScene(stdout, scene) == SCE_PFX_OK ? 0 : 1;
}
