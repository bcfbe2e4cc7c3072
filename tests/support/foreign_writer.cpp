// Writes the scene of foreign_scene.h to standard output. Compiled for another kind of machine it shows what
// files from there look like: tests/files/data/big_endian.scene came from s390x-linux-gnu-g++ (with the
// headers of libsimde-dev in place of emmintrin.h) and qemu-s390x. A build of 32 bits (-m32) writes the same bytes, and
// reads them as the same scene.
#include "tests/files/foreign_scene.h"

int main() {
  files::SceneVectors scene = files::foreignScene();
  return static_cast<int>(pfx::serializeWrite(stdout, files::writeCalls(scene)));
}
