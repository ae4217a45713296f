// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh.h"
#include "physics/springs.h"
