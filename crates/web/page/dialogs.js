// Files that the person chooses, and files that are given to the person.

const PERSONS = "/files/";

// What the person chose to write to, by the paths in the studio's store, where the browser can write files.
const handles = new Map();

// Asks the person; gives back the path in the studio's store, or `null`.
export function answerFileRequest(request, take) {
  return request.isSaving ? askToSave(request) : askToOpen(request, take);
}

async function askToSave({ name, extensions }) {
  if (extensions.length === 0 || !self.showSaveFilePicker) {
    return PERSONS + name;
  }
  const types = [{ accept: { "application/octet-stream": extensions.map((extension) => `.${extension}`) } }];
  try {
    const handle = await self.showSaveFilePicker({ suggestedName: name, types });
    const path = PERSONS + handle.name;
    handles.set(path, handle);
    return path;
  } catch (error) {
    // Cancelled; or too late after the click, and then it is downloaded.
    return error.name === "AbortError" ? null : PERSONS + name;
  }
}

function askToOpen({ extensions }, take) {
  return new Promise((resolve) => {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = extensions.map((extension) => `.${extension}`).join(",");
    input.onchange = async () => resolve((await take(input.files))[0] ?? null);
    input.oncancel = () => resolve(null);
    input.click();
  });
}

// Gives the person a file that the studio has written, if it is one of the person's.
export async function give(path, bytes) {
  if (!path.startsWith(PERSONS)) {
    return;
  }
  const handle = handles.get(path);
  if (handle) {
    const file = await handle.createWritable();
    await file.write(bytes);
    await file.close();
    return;
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = path.slice(path.lastIndexOf("/") + 1);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
