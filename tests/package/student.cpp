#include "bounce.h"

int main(int argc, char** argv) {
  return offstage::run<Bounce>(argc, argv);
}
