// Files of volumes: NIfTI .nii and .nii.gz, NRRD .nrrd and .nhdr, DICOM series. They are read in one pass, however
// large they are.
#pragma once

#include <string>

#include "io/model_file.h"
#include "io/volume_sink.h"

namespace hl {

/// Whether a reader takes files of this ending (".nii").
bool readsVolumes(const std::string& ending);

/// Whether it is a folder with DICOM files in it. readVolume() takes it, with an empty ending.
bool isDicomFolder(const std::string& path);

/// In a process of its own; throws on failure. Where the file says where it lies in a patient, it lies there, with its
/// middle moved to the origin.
void readVolume(const ModelFile& file, VolumeSink& sink);

// For readVolume().
void readNifti(const ModelFile& file, VolumeSink& sink);
void readNrrd(const ModelFile& file, VolumeSink& sink);
/// Of a folder the series with the most slices; of a file with one slice its series in the folder.
void readDicom(const ModelFile& file, VolumeSink& sink);

}  // namespace hl
