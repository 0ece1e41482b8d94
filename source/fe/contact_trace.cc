#include <vibrocontact/fe/contact_trace.h>

namespace vibrocontact
{
  ContactTrace joined(const std::vector<ContactTrace> &traces)
  {
    if (traces.size() == 1)
      return traces.front();
    ContactTrace result;
    result.grid = traces.front().grid;
    for (unsigned int component = 0; component < 3; ++component)
      for (const ContactTrace &trace : traces)
        for (unsigned int i = 0; i < trace.grid.n_points(); ++i)
        {
          const unsigned int row = contact_row(trace.grid.n_points(), component, i);
          result.rows.push_back(trace.rows[row]);
          result.lifting.push_back(!trace.lifting.empty() ? trace.lifting[row] : component == 0 ? 1. : 0.);
        }
    for (const ContactTrace &trace : traces)
      result.surface_height.insert(result.surface_height.end(), trace.surface_height.begin(),
                                   trace.surface_height.end());
    return result;
  }
} // namespace vibrocontact
