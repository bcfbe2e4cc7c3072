// The overview's own API in one header: namespace sce::PhysicsEffects over the engine's data and stages.
// Needs C++14 and nothing but the standard library; link with the engine and a thread library.
#pragma once

#include "physics_effects/base.h"
#include "physics_effects/broadphase.h"
#include "physics_effects/contact.h"
#include "physics_effects/debug_render.h"
#include "physics_effects/heap.h"
#include "physics_effects/island.h"
#include "physics_effects/joint.h"
#include "physics_effects/mesh.h"
#include "physics_effects/perf_counter.h"
#include "physics_effects/ray.h"
#include "physics_effects/rigid_body.h"
#include "physics_effects/rigid_body_world.h"
#include "physics_effects/serialize.h"
#include "physics_effects/shape.h"
#include "physics_effects/solver.h"
#include "physics_effects/sort.h"
#include "physics_effects/task.h"
