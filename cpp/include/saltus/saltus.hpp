// Everything.
#pragma once

#include "saltus/collision/contact.hpp"
#include "saltus/collision/gap.hpp"
#include "saltus/model/close_loops.hpp"
#include "saltus/model/dynamics.hpp"
#include "saltus/model/model_builder.hpp"
#include "saltus/model/stiff_damping.hpp"
#include "saltus/rollout/batch.hpp"
#include "saltus/rollout/simulate.hpp"
#include "saltus/urdf/load_urdf.hpp"
#include "saltus/variational/cascade.hpp"
#include "saltus/variational/certificate.hpp"
#include "saltus/variational/friction.hpp"
#include "saltus/variational/outcomes.hpp"
#include "saltus/variational/overlap.hpp"
#include "saltus/variational/stepper.hpp"
