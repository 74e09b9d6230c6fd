// A browser loads no module of a page that was opened as a file: this plain script alone can say so.
if (location.protocol === "file:") {
  const words = new Map([
    [
      "en",
      "This page was opened as a file, and browsers load no modules from there. Open it with groma view SCAN, or through any server of files.",
    ],
    [
      "de",
      "Diese Seite wurde als Datei geöffnet, und von dort laden Browser keine Module. Öffnen Sie sie mit groma view SCAN oder über einen Dateiserver.",
    ],
    [
      "es",
      "Esta página se abrió como archivo, y los navegadores no cargan módulos desde ahí. Ábrala con groma view SCAN o con un servidor de archivos.",
    ],
    [
      "fr",
      "Cette page a été ouverte comme un fichier, et les navigateurs n’y chargent pas de modules. Ouvrez-la avec groma view SCAN ou par un serveur de fichiers.",
    ],
    [
      "ja",
      "このページはファイルとして開かれたため、ブラウザーがモジュールを読み込めません。groma view SCAN またはファイルサーバーで開いてください。",
    ],
  ]);
  const language = navigator.languages.map((tag) => tag.slice(0, 2)).find((code) => words.has(code)) ?? "en";
  const place = document.getElementById("message");
  const code = document.createElement("p");
  code.className = "code";
  code.textContent = "PAGE_FILE";
  place.replaceChildren(code, words.get(language));
  document.documentElement.lang = language;
  // Nothing else on the page would answer.
  document.body.replaceChildren(place);
}
