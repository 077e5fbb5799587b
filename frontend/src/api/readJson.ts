/** The content of a JSON file, or a sentence that says what is wrong with it. */
export async function readJson(file: Blob & { name?: string }): Promise<unknown> {
  const text = await file.text();
  try {
    return JSON.parse(text);
  } catch {
    throw new Error(`“${file.name ?? "The file"}” is no GeoJSON: it does not hold JSON text. Export it again as GeoJSON.`);
  }
}
