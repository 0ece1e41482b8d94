#include <vibrocontact/contact/secant_pairs.h>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_pairs = 8;
    /// differences that the later ones leave so little of say nothing new
    constexpr double least_share = 1e-3;
  } // namespace

  void SecantPairs::clear()
  {
    differences.clear();
    steps.clear();
  }

  void SecantPairs::add(const DenseVector &difference, const DenseVector &step)
  {
    if (differences.size() == most_pairs)
    {
      differences.erase(differences.begin());
      steps.erase(steps.begin());
    }
    differences.push_back(difference);
    steps.push_back(step);
  }

  DenseVector SecantPairs::take_known_part(DenseVector &residual) const
  {
    DenseVector known(residual.size());
    // modified Gram-Schmidt from the latest on: where pairs contradict each other, it is right
    std::vector<DenseVector> Q, X;
    for (std::size_t k = differences.size(); k-- > 0;)
    {
      DenseVector q(differences[k]), x(steps[k]);
      const double before = q.l2_norm();
      for (std::size_t j = 0; j < Q.size(); ++j)
      {
        const double share = q * Q[j];
        q.add(-share, Q[j]);
        x.add(-share, X[j]);
      }
      const double after = q.l2_norm();
      if (!(after > least_share * before))
        continue;
      q /= after;
      x /= after;
      const double share = residual * q;
      residual.add(-share, q);
      known.add(share, x);
      Q.push_back(q);
      X.push_back(x);
    }
    return known;
  }
} // namespace vibrocontact
