#include "vtk_bytes.h"

#include <transillum/base/error.h>

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <new>

namespace transillum {

namespace {

/// Keeps the first message; an observed object prints nothing.
class MessageKeeper : public vtkCommand {
public:
    static MessageKeeper* New() { return new MessageKeeper; }
    void Execute(vtkObject*, unsigned long, void* text) override {
        if (message.empty() && text != nullptr) message = static_cast<const char*>(text);
        std::replace(message.begin(), message.end(), '\n', ' ');
    }
    std::string message;
};

void observe(vtkObject& object, MessageKeeper& keeper) {
    object.AddObserver(vtkCommand::ErrorEvent, &keeper);
    object.AddObserver(vtkCommand::WarningEvent, &keeper);
}

std::string reason(vtkAlgorithm& algorithm, const MessageKeeper& keeper) {
    if (!keeper.message.empty()) return keeper.message;
    return "error code " + std::to_string(algorithm.GetErrorCode());
}

template <class Writer, class Data>
std::string to_bytes(Data& data, const std::filesystem::path& file) {
    vtkNew<MessageKeeper> keeper;
    vtkNew<Writer> writer;
    observe(*writer, *keeper);
    writer->SetInputData(&data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetHeaderTypeToUInt64();
    writer->SetByteOrderToLittleEndian();
    writer->WriteToOutputStringOn();
    const bool written = writer->Write() != 0;
    if (!written || writer->GetErrorCode() != vtkErrorCode::NoError || !keeper->message.empty()) {
        throw IoError(file.string(), "VTK cannot write: " + reason(*writer, *keeper));
    }
    return writer->GetOutputString();
}

template <class Reader, class Data>
vtkSmartPointer<Data> from_bytes(const std::string& bytes, const std::filesystem::path& file) try {
    vtkNew<MessageKeeper> keeper;
    vtkNew<Reader> reader;
    observe(*reader, *keeper);
    observe(*reader->GetExecutive(), *keeper);
    reader->SetParserErrorObserver(keeper);
    reader->ReadFromInputStringOn();
    reader->SetInputString(bytes);
    reader->Update();
    if (reader->GetErrorCode() != vtkErrorCode::NoError || !keeper->message.empty()) {
        throw InputError(file.string(), "VTK cannot read: " + reason(*reader, *keeper));
    }
    return reader->GetOutput();
} catch (const std::bad_alloc&) {
    throw InputError(file.string(), "asks for more memory than there is");
}

}  // namespace

std::string to_vtp(vtkPolyData& data, const std::filesystem::path& file) {
    return to_bytes<vtkXMLPolyDataWriter>(data, file);
}

std::string to_vti(vtkImageData& data, const std::filesystem::path& file) {
    return to_bytes<vtkXMLImageDataWriter>(data, file);
}

vtkSmartPointer<vtkPolyData> from_vtp(const std::string& bytes, const std::filesystem::path& file) {
    return from_bytes<vtkXMLPolyDataReader, vtkPolyData>(bytes, file);
}

vtkSmartPointer<vtkImageData> from_vti(const std::string& bytes,
                                       const std::filesystem::path& file) {
    return from_bytes<vtkXMLImageDataReader, vtkImageData>(bytes, file);
}

}  // namespace transillum
