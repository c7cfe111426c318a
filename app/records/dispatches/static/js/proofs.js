/** Proof of delivery: who took it, a photo made small, and a signature drawn with a finger. */

const SIDE = 1280; // pixels of a photo at most
const MOST = 380_000; // bytes of a photo

/** Return the content of a picture in base64. */
async function base64(blob) {
  const url = await new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
  return url.slice(url.indexOf(',') + 1);
}

const blobOf = (canvas, type, quality) =>
  new Promise((resolve) => {
    canvas.toBlob(resolve, type, quality);
  });

/** Return a photo, made small, in base64. */
export async function smallPhoto(file) {
  const picture = await createImageBitmap(file);
  for (let side = SIDE; ; side /= 2) {
    const scale = Math.min(1, side / Math.max(picture.width, picture.height));
    const canvas = document.createElement('canvas');
    canvas.width = Math.max(1, Math.round(picture.width * scale));
    canvas.height = Math.max(1, Math.round(picture.height * scale));
    canvas.getContext('2d').drawImage(picture, 0, 0, canvas.width, canvas.height);
    const blob = await blobOf(canvas, 'image/jpeg', 0.7);
    if (blob.size <= MOST) return base64(blob);
  }
}

/** Return a signature in base64. */
export async function signatureOf(canvas) {
  return base64(await blobOf(canvas, 'image/png'));
}

/** Let a canvas be drawn on; `onDraw` is told once something is. */
export function drawOn(canvas, onDraw) {
  canvas.width = canvas.clientWidth;
  canvas.height = canvas.clientHeight;
  const context = canvas.getContext('2d');
  // On paper, whatever the phone's colours are.
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  Object.assign(context, { strokeStyle: '#111', lineWidth: 2.5, lineCap: 'round' });
  canvas.onpointerdown = ({ pointerId, offsetX, offsetY }) => {
    canvas.setPointerCapture(pointerId);
    context.beginPath();
    context.moveTo(offsetX, offsetY);
  };
  canvas.onpointermove = ({ buttons, offsetX, offsetY }) => {
    if (!buttons) return;
    context.lineTo(offsetX, offsetY);
    context.stroke();
    onDraw();
  };
}
