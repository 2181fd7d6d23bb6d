#pragma once
/// \file campaign.hpp
/// Attacks with many fields, as a program does that is told how many.

#include <functional>

#include "finding.hpp"
#include "trial.hpp"

namespace difmesh::attack {

/// What else to hold against the surface of a trial in which nothing was wrong; may be empty.
using FurtherCheck = std::function<Finding(const Trial&)>;

/// A whole program:
///   [--fields N] [--first SEED] [--step N] [--seconds S] [--most-findings N]
///   --seed SEED    this field only, told in the words of C
/// Fields are made from seeds alone: SEED, SEED + N, ... Tells what is wrong, at most so many
/// findings of a kind, made small. \return 0 if nothing is wrong, 1 if something is, 2 for other
/// arguments
int run_campaign(int argc, char** argv, const FurtherCheck& further = {});

}  // namespace difmesh::attack
