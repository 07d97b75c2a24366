// Times of Pinocchio's kernels, without Python's calls: bench_pinocchio SECONDS FILE...
//
// Arguments, clock and output as in bench_kernels.cpp.
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <iostream>
#include <string>

#include "clock.hpp"

namespace {

using Eigen::VectorXd;
using saltus::bench::Job;
using saltus::bench::time_of;

void run(double budget, const Job& job) {
  pinocchio::Model model;
  if (job.floating) {
    pinocchio::urdf::buildModel(job.file, pinocchio::JointModelFreeFlyer(), model);
  } else {
    pinocchio::urdf::buildModel(job.file, model);
  }
  pinocchio::Data data(model);
  const VectorXd q = pinocchio::integrate(model, pinocchio::neutral(model),
                                          VectorXd(VectorXd::Constant(model.nv, job.angle)));
  const VectorXd v = VectorXd::Constant(model.nv, 0.1), a = v;
  std::cout << "{\"model\": \"" << model.name << "\", \"n\": " << model.nv
            << ", \"rnea\": " << time_of(budget, [&] { pinocchio::rnea(model, data, q, v, a); })
            << ", \"aba\": " << time_of(budget, [&] { pinocchio::aba(model, data, q, v, a); })
            << ", \"derivatives\": "
            << time_of(budget, [&] { pinocchio::computeRNEADerivatives(model, data, q, v, a); })
            << ", \"aba_derivatives\": "
            << time_of(budget, [&] { pinocchio::computeABADerivatives(model, data, q, v, a); })
            << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) { return saltus::bench::main(argc, argv, run); }
