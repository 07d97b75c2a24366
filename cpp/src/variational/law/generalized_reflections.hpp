// Contacts that hit together: generalized reflections, and the projection that is their e = 0.
//
// Generalized reflections: D. Kaufman et al., "Reflections on Simultaneous Impact", SIGGRAPH 2012.
// A round takes all contacts that approach and reflects v in the face of their cone that is
// nearest in the kinetic metric:
//
//   w = argmin |w - v|_M^2 / 2  subject to  N w >= 0  =  v + M^-1 N^T lambda,  v+ = v + (1 + e)(w -
//   v)
//
// and rounds go on until none approaches. Contacts that do not feel each other (no chain of
// G_ij != 0 joins them) are rounds of their own. Where those that do have unlike e_i, a round takes
//
//   e^2 = sum e_i^2 lambda_i |u_i| / sum lambda_i |u_i|
//
// so that each loses the part 1 - e_i^2 of the energy that went into it; impulses (1 + e_i)
// lambda_i would do so for like e_i only, and can gain energy for others.
#pragma once

#include "saltus/variational/cascade.hpp"

namespace saltus {

/// ImpactOrder::symmetric; arguments as for cascade(). Impulses of a round come in order of index
/// within each group of contacts that feel each other.
/// @return false when max_impulses did not suffice; @throws StepError as contact_multipliers does.
bool reflect_together(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
                      const VecRef& restitution, int max_impulses, std::vector<Impulse>& impulses);

/// All e_i = 0: p+ = p- + N^T lambda, 0 <= lambda, N v+ >= 0, one of both 0 at each contact.
/// @throws StepError as contact_multipliers does.
void project(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
             std::vector<Impulse>& impulses);

}  // namespace saltus
