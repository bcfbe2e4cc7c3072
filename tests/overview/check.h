// What the programs need beside physics_effects.h: a check that counts failures and says where.
#pragma once

#include <cstdio>

static int failures = 0;
#define CHECK(test) \
  do { \
    if (!(test)) ++failures, std::printf("%s:%d: %s\n", __FILE__, __LINE__, #test); \
  } while (0)
