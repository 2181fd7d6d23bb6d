// Attacks the library with ugly fields: see trial.hpp for what must hold, campaign.hpp for
// arguments.

#include "campaign.hpp"

int main(int argc, char** argv) {
  return difmesh::attack::run_campaign(argc, argv);
}
