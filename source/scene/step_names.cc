#include <vibrocontact/scene/step_names.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace vibrocontact
{
  namespace
  {
    /// As it is in the file; empty for what OpenCASCADE calls things without a name.
    std::string name_of(const TDF_Label &label)
    {
      Handle(TDataStd_Name) name;
      if (!label.FindAttribute(TDataStd_Name::GetID(), name))
        return "";
      const TCollection_ExtendedString &wide = name->Get();
      std::string text(wide.LengthOfCString() + 1, '\0');
      Standard_PCharacter to = text.data();
      wide.ToUTF8CString(to);
      text.resize(wide.LengthOfCString());
      return text == "SOLID" || text == "COMPOUND" || text.rfind("Open CASCADE", 0) == 0 ? "" : text;
    }

    dealii::Point<3> centre_of(const GProp_GProps &properties)
    {
      const gp_Pnt centre = properties.CentreOfMass();
      return {centre.X(), centre.Y(), centre.Z()};
    }

    GProp_GProps volume_of(const TopoDS_Shape &solid)
    {
      GProp_GProps properties;
      BRepGProp::VolumeProperties(solid, properties);
      return properties;
    }

    void add_solid(const std::string &name, const TopoDS_Shape &solid, std::vector<StepName> &names)
    {
      const GProp_GProps properties = volume_of(solid);
      names.push_back({name, true, properties.Mass(), centre_of(properties), centre_of(properties)});
    }

    /// The solids of a part.
    std::vector<TopoDS_Shape> solids_of(const TopoDS_Shape &part)
    {
      std::vector<TopoDS_Shape> solids;
      for (TopExp_Explorer solid(part, TopAbs_SOLID); solid.More(); solid.Next())
        solids.push_back(solid.Current());
      return solids;
    }

    /// What is named within a part. @param where it is placed @param with_solids of one solid the part's own name comes first
    void add_names_within(const TDF_Label &label, const std::vector<TopoDS_Shape> &solids,
                          const bool with_solids, const TopLoc_Location &where, std::vector<StepName> &names)
    {
      for (TDF_ChildIterator child(label); child.More(); child.Next())
      {
        TopoDS_Shape shape;
        const std::string name = name_of(child.Value());
        if (!name.empty() && XCAFDoc_ShapeTool::GetShape(child.Value(), shape))
        {
          if (shape.ShapeType() == TopAbs_SOLID && with_solids)
            add_solid(name, shape.Moved(where), names);
          else if (shape.ShapeType() == TopAbs_FACE)
            for (const TopoDS_Shape &solid : solids)
              for (TopExp_Explorer face(solid, TopAbs_FACE); face.More(); face.Next())
                if (face.Current().IsSame(shape))
                {
                  GProp_GProps properties;
                  BRepGProp::SurfaceProperties(shape.Moved(where), properties);
                  names.push_back({name, false, properties.Mass(), centre_of(properties),
                                   centre_of(volume_of(solid.Moved(where)))});
                }
        }
        add_names_within(child.Value(), solids, with_solids, where, names);
      }
    }

    /// Of a part, or of all parts of an assembly.
    void add_names(const TDF_Label &label, const TopLoc_Location &where, std::vector<StepName> &names)
    {
      if (XCAFDoc_ShapeTool::IsAssembly(label))
      {
        TDF_LabelSequence components;
        XCAFDoc_ShapeTool::GetComponents(label, components);
        for (const TDF_Label &component : components)
        {
          TDF_Label part;
          if (XCAFDoc_ShapeTool::GetReferredShape(component, part))
            add_names(part, where * XCAFDoc_ShapeTool::GetLocation(component), names);
        }
        return;
      }
      TopoDS_Shape shape;
      if (!XCAFDoc_ShapeTool::GetShape(label, shape))
        return;
      const std::vector<TopoDS_Shape> solids = solids_of(shape);
      const std::string name = name_of(label);
      const bool is_named = solids.size() == 1 && !name.empty();
      if (is_named)
        add_solid(name, solids.front().Moved(where), names);
      add_names_within(label, solids, !is_named, where, names);
    }
  } // namespace

  std::vector<StepName> step_names(const std::string &file)
  {
    // the reader makes these options, with their defaults
    STEPCAFControl_Controller::Init();
    Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
    Interface_Static::SetCVal("xstep.cascade.unit", "M");
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    STEPCAFControl_Reader reader;
    reader.SetNameMode(true);
    std::vector<StepName> names;
    if (reader.ReadFile(file.c_str()) == IFSelect_RetDone && reader.Transfer(document))
    {
      TDF_LabelSequence parts;
      XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(parts);
      for (const TDF_Label &part : parts)
        add_names(part, TopLoc_Location(), names);
    }
    return names;
  }
} // namespace vibrocontact
