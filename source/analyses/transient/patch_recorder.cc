#include <vibrocontact/analyses/transient/patch_recorder.h>
#include <vibrocontact/output/contact_patch.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/surface_fields.h>

namespace vibrocontact
{
  PatchRecorder::PatchRecorder(const PlacedContacts &contacts, const double begin, const double interval,
                               const std::string &folder)
      : contacts(contacts), begin(begin), interval(interval), folder(folder)
  {
  }

  void PatchRecorder::add(const DynamicState &state)
  {
    // the first state may have no contact solution: bodies apart
    if (state.time < begin + interval * (times.size() - 1e-6) || state.contact.empty())
      return;
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      write_contact_patch(state.contact, contacts, k, true,
                          folder + "/" + field_name(with_contact("patch", contacts.all[k]), times.size()));
    times.push_back(state.time);
  }

  void PatchRecorder::exchange(CheckpointFile &file)
  {
    file("patch/times", times);
  }

  void PatchRecorder::finish(bool)
  {
    for (const PlacedContact &contact : contacts.all)
    {
      const std::string name = with_contact("patch", contact);
      std::vector<std::pair<double, std::string>> files;
      for (unsigned int k = 0; k < times.size(); ++k)
        files.emplace_back(times[k], field_name(name, k));
      write_pvd(files, folder + "/" + name + ".pvd");
    }
  }
} // namespace vibrocontact
