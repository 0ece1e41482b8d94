#pragma once

#include <vibrocontact/analyses/periodic/massless_points.h>

#include <vector>

namespace vibrocontact
{
  /// Contact points without mass (massless_points.h) sample after sample. Forces follow from the motion w of the modes
  /// alone - a history of it, since the points stick and slip -, with the rates that Newton's method asks for; they need no
  /// functions of time of their own.
  class MasslessContact
  {
  public:
    /// @param residual S, positive on the diagonal; rows: normal, two tangential of each point
    /// @param friction coefficient of each point [-]
    MasslessContact(const DenseMatrix &residual, const std::vector<double> &friction);

    /// Marches through the samples of w (row after row), from one where no point touches; twice if there is none. Fills
    /// the samples of the forces on the body, p (same layout).
    /// @return false if a sample found no solution
    bool march(const std::vector<double> &w, const std::vector<double> &gap, std::vector<double> &p);

    /// Of the last march, at the samples of each point.
    const std::vector<ContactStatus> &status() const { return statuses; }

    /// Moments of the rates of p: for every sample k, weight(k, i) (dp_r / dw_(s, j) basis(., j)) summed into
    /// (r n_weights + i, s n_functions + j) of `into`. After march(). @param growth of the basis, less of the weights, over
    /// an interval between samples: rates of motions that are periodic but for a factor e^(growth k)
    void add_rates(const DenseMatrix &basis, const DenseMatrix &weights, DenseMatrix &into,
                   double growth = 0) const;

  private:
    MasslessPoints points;
    const unsigned int n;
    /// order of the samples; dp/dw of each in contact, empty in flight
    std::vector<unsigned int> order;
    std::vector<std::vector<double>> rates;
    std::vector<ContactStatus> statuses;
  };
} // namespace vibrocontact
