// The clipboard. Where the browser refuses, nothing is copied.

export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch (error) {
    console.warn("The clipboard refuses:", error);
    return false;
  }
}

export async function pasteText() {
  try {
    return await navigator.clipboard.readText();
  } catch (error) {
    console.warn("The clipboard refuses:", error);
    return "";
  }
}

export async function copyImage([width, height, bytes]) {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(bytes), width, height), 0, 0);
  try {
    await navigator.clipboard.write([new ClipboardItem({ "image/png": canvas.convertToBlob({ type: "image/png" }) })]);
  } catch (error) {
    console.warn("The clipboard refuses:", error);
  }
}
