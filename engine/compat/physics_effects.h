// The overview's own API in one header: namespace sce::PhysicsEffects over the engine's data and stages.
// Needs C++14 and nothing but the standard library; link with the engine and a thread library.
#pragma once

#include "compat/base.h"
#include "compat/broadphase.h"
#include "compat/contact.h"
#include "compat/island.h"
#include "compat/joint.h"
#include "compat/mesh.h"
#include "compat/ray.h"
#include "compat/rigid_body.h"
#include "compat/shape.h"
#include "compat/solver.h"
#include "compat/sort.h"
#include "compat/task.h"
